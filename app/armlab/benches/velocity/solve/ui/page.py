"""The page for joint speeds: how many there are, the shortest, the four subspaces, and singularity with its reason."""

from __future__ import annotations

import asyncio
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.solve.examples import EXAMPLES, ChooseSolveExample
from armlab.benches.velocity.solve.found import Found, found
from armlab.benches.velocity.solve.motion import BeginAlong, SlideAlong, begun, looked_for, part_of
from armlab.benches.velocity.solve.state import CLIP_KEY, FASTEST, AskFor, SetComponent, Solve, has_choice
from armlab.benches.velocity.solve.ui.words import (
    components,
    legend,
    markup_of,
    measures_markup,
    null_markup,
    penrose_markup,
    reached_markup,
    singular_card,
    speeds_markup,
    verdict,
)
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, matrix, readable
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold, row, verdict_box
from armlab.ui.matrices import WIDE, copy_buttons
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

STEPS = 200
"""Number of steps of the slider along a self-motion."""

REST = 0.4
"""Time without a motion after which the page looks for the self-motion of the arm, seconds."""

ASKED = {"task": "Whole task", "position": "Position alone"}

FOLDS = {"subspaces": "Four subspaces", "svd": "U, Σ, V", "penrose": "Penrose conditions"}


class SolvePage:
    """The page Inverse velocity."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._units = units_of(state)
        self._unfolded: set[str] = set()
        self._head, self._verdict, self._speeds = gui.form(post), gui.html(), gui.html()
        self._motion = _SelfMotion(gui, post)
        self._singular, self._folds = gui.html(), gui.form(post)

    def _fold(self, key: str) -> None:
        self._unfolded ^= {key}

    def show(self, state: State) -> None:
        """Show a state."""
        units, solved = self._units, state.derived(found)
        self._head.show(head_markup(self._head, state, solved, units))
        self._verdict.show(verdict_box(*verdict(solved, units)), legend(), reached_markup(solved, units))
        self._speeds.show(speeds_markup(solved, units), null_markup(solved, units))
        self._motion.show(state, solved)
        self._singular.show(singular_markup(solved))
        self._folds.show(self._folded(solved))

    def _folded(self, solved: Found) -> Inside:
        parts = []
        for key, title in FOLDS.items():
            on = key in self._unfolded
            turned = partial(self._fold, key)
            unfolded = str(on).lower()
            press = self._folds.button(key, title, turned, "kit-unfolds", aria_expanded=unfolded)
            parts.append((press, MADE[key](solved) if on else None))
        return parts


def head_markup(form: Form, state: State, solved: Found, units: Units) -> Markup:
    """Return the choices of an example and of the rows, and the fields of the wanted velocity."""
    part = state[Solve]
    chooser, asked = examples(form, EXAMPLES, part.example, ChooseSolveExample, said=units.said), None
    if has_choice(part.arm):
        hint = "What is asked of the tool; the rest of its motion is left free"
        chips = [form.chip(f"rows-{key}", text, AskFor(key), hint, key == part.rows) for key, text in ASKED.items()]
        asked = row("Asked", chips, wide=True)
    cells = []
    for k, (name, turning) in enumerate(components(solved.arm.task)):
        shown = readable(part.twist[k] / units.factor(turning), units.decimals(turning))
        field = form.field(f"v-{k}", shown, f"{name} wanted", partial(_component, k, name, turning, units))
        cells.append(tag("label", tag("span", markup_of(name)), field, tag("i", f"{units.unit(turning)}/s")))
    frame = "frame 0" + ("; ωx′, ωy′ about x, y of the tool" if part.arm.task.rotation == "approach" else "")
    aside = tag("small", f"in axes of {frame}; or drag the blue arrow")
    title = tag("h3", "Wanted velocity ", mathml("v"), " ", aside)
    return joined(chooser, asked, title, tag("div.kit-twist", cells))


def _component(k: int, name: str, turning: bool, units: Units, text: str) -> SetComponent:
    return SetComponent(k, units.read(text, turning, name, "/s", (-FASTEST, FASTEST)))


def singular_markup(solved: Found) -> Markup:
    """Return whether J is singular, by rank, determinant and singular values; open where it is."""
    inside = singular_card(solved), measures_markup(solved)
    head = "Is J singular? ", tag("small", f"rank {solved.spaces.rank}")
    return fold(head, *inside, opened=solved.singular, key="Is J singular?")


def svd_markup(solved: Found) -> Markup:
    """Return U, Σ and V."""
    spaces = solved.spaces
    sigma: NDArray[np.float64] = np.zeros(solved.J.shape)
    np.fill_diagonal(sigma, spaces.sigma)
    written = mathml((r"\bar{J}" if solved.is_scaled else "J") + r"=U\,\Sigma\,V^T")
    parts = [
        (tag("h3", mathml(name), tag("span.copies", copy_buttons(values))), _scrolled(values))
        for name, values in (("U", spaces.U), (r"\Sigma", sigma), ("V", spaces.V))
    ]
    m, n = solved.J.shape
    said = f"U is {m} × {m}, Σ {m} × {n}, V {n} × {n}⟦ (definition 11 has U and V exchanged)⟧."
    said += " J̄ is J with metres and joint speeds scaled as said above." if solved.is_scaled else ""
    return joined(tag("div.eq.small", written), parts, tag("p.dim", said))


def spaces_markup(solved: Found) -> Markup:
    """Return bases of the four subspaces, as columns."""
    spaces = solved.spaces
    parts = []
    for name, what, basis in (
        ("R(J)", "velocities that are reached", spaces.range),
        ("N(J^T)", "lost: no joint speed gives a component along these", spaces.lost),
        ("R(J^T)", "joint speeds that count", spaces.row),
        ("N(J)", "joint speeds that leave the tool where it is", spaces.null),
    ):
        inside = _scrolled(basis) if basis.shape[1] else tag("p.dim", "only zero")
        aside = tag("small", f"{what}; dimension {basis.shape[1]}")
        parts.append((tag("h3", mathml(name), " ", aside), inside))
    said = (
        "Columns, in m/s and rad/s⟦ (5.72–5.78)⟧. Every v with a component in N(Jᵀ) is infeasible, not only those "
        "that lie in it."
    )
    return joined(parts, tag("p.dim", said))


def _scrolled(values: NDArray[np.float64]) -> Markup:
    """Return a matrix, set more closely if it has many columns."""
    wide = values.shape[1] > WIDE
    return tag("div.scroll.so-wide" if wide else "div.scroll", matrix(values, 2 if wide else 3))


MADE = {"subspaces": spaces_markup, "svd": svd_markup, "penrose": penrose_markup}


class _SelfMotion:
    """The slider and the film of the motion that leaves the tool still."""

    def __init__(self, gui: Gui, post: Post) -> None:
        self._post = post
        self._slider = gui.slider("Along, %", 0.0, 100.0, 100.0 / STEPS, 0.0, self._slid, None)
        self._slider.handle.visible = False
        self._play = gui.form(post)
        self._later: asyncio.TimerHandle | None = None
        self._looked: tuple[object, ...] = ()

    def _slid(self, value: float) -> None:
        self._post(SlideAlong(value / 100.0))

    def show(self, state: State, solved: Found) -> None:
        """Show the place of the arm on its self-motion, as soon as the arm rests."""
        part = part_of(state) if solved.answer.free.shape[1] else None
        on = part is not None
        if self._slider.handle.visible != on:
            self._slider.handle.visible = on
        if part is not None:
            self._slider.show(round(part * STEPS) * 100.0 / STEPS)
        self._play.show(self._words(state, solved, on))
        if not on and solved.answer.free.shape[1]:
            self._look(state)

    def _look(self, state: State) -> None:
        """Look for the self-motion through the configuration when the arm has rested a while, once for each place."""
        here = (state[Joints].arm, state[Joints].q.tobytes(), state[Joints].locked, state[Solve].rows)
        if here == self._looked or state[Timeline].playing:
            return
        self._looked = here
        if self._later is not None:
            self._later.cancel()
        self._later = asyncio.get_running_loop().call_later(REST, self._post, BeginAlong())

    def _words(self, state: State, solved: Found, on: bool) -> Markup | None:
        if not solved.answer.free.shape[1]:
            return None
        if not on:
            found = "none; these speeds leave the tool in place to first order only." if looked_for(state) else "…"
            return tag("p.dim", f"Self-motion: {found}")
        hint = "Move the arm along and back; the tool stays"
        press = play_button(self._play, state, CLIP_KEY, "self", kind="chip", hint=hint)
        way = begun(state)
        kind = "closed" if way is not None and way[1].closed else "from end to end"
        return tag("div.bar", press, tag("span.dim", f"Self-motion, {kind}: the tool stays."))


def around(state: State) -> Points:
    """Return the ends of the arrow of the wanted velocity, which must be inside the picture."""
    solved = state.derived(found)
    tool = np.asarray(solved.arm.position(solved.q), dtype=np.float64)
    return np.array([tool, tool + solved.vectors(solved.v)[0]])


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the page."""
    return SolvePage(gui, state, post).show


PANEL = Panel((Joints, Solve, Timeline), build, around=around)
