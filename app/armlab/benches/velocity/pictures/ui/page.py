"""Two joints of a planar arm in pictures: two lines, the norm against det J, and the torus of joint values cut open."""

from __future__ import annotations

import math
from itertools import islice

import numpy as np

from armlab.benches.velocity.solve.pictures import (
    DragTo,
    Square,
    StandAt,
    flat,
    key_of,
    norm_curve,
    refusal,
    square,
    suited,
    suits,
)
from armlab.benches.velocity.solve.state import Solve
from armlab.benches.velocity.solve.ui.pictures import lines_svg, lines_words, marks_style, norm_svg, square_markup
from armlab.benches.velocity.solve.ui.torus import pressed, torus_markup, torus_style
from armlab.benches.velocity.solve.ui.words import small
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import Post, State
from armlab.ui.form import Form, Wish
from armlab.ui.format import mathml
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

MOST_OFFERED = 5
"""Largest number of arms that are offered in place of one without pictures."""


class PicturesPage:
    """The page Joint space."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._units = units_of(state)
        self._head, self._lines, self._map = gui.form(post), gui.html(), gui.form(post)
        self._mark, self._norm = gui.html(), gui.html()
        self._drawn: object = None

    def show(self, state: State) -> None:
        """Show a state; the square is sent only when its singular set has changed."""
        self._head.show(head_markup(self._head, state, self._units))
        why = refusal(state)
        for element in (self._lines, self._mark, self._norm):
            element.visible(not why)
        if why:
            self._drawn = why
            self._map.show(verdict_box("todo", "Not for this arm", why), arms_markup(self._map, state))
            return
        units, found = self._units, flat(state)
        aside = tag("small", "⟦1.18–1.24; ⟧rows of J, not columns")
        title = tag("h3", "Two lines ", mathml(r"J\dot q=v"), " ", aside)
        self._lines.show(title, lines_svg(state, found, units), lines_words(state, found, units))
        place = square(state)
        key = key_of(state)
        if key != self._drawn or self._map.stale:
            self._drawn = key
            self._map.show(maps_markup(self._map, state, place, units))
        self._mark.show(marks_style(state, place, found), torus_style(state, found))
        self._norm.show(norm_markup(state, units))


def arms_markup(form: Form, state: State) -> Markup | None:
    """Return a button for each of the simplest arms with which the page works, where the present one never does."""
    if suits(state[Joints].arm):
        return None
    simplest = islice(suited().items(), MOST_OFFERED)
    hint = "Put this arm on the table; undo brings the present one back"
    chips = [form.chip(f"arm {key}", name, ChooseRobot(key), hint) for key, name in simplest]
    drawn = "The scene shows the wanted velocity of the tool, as on the page Inverse velocity."
    return joined(tag("h3", "Choose an arm that has such joints"), tag("div.bar", chips), tag("p.dim", drawn))


def head_markup(form: Form, state: State, units: Units) -> Markup | None:
    """Return the choice of the two joints."""
    arm, pair = state[Joints].arm, state[Solve].pair
    if arm.n < 3 or not arm.description.axes_parallel:
        return None
    names = {str(k): units.variable(k, bool(arm.revolute[k])) for k in range(arm.n)}

    def choice(side: int, which: str) -> Markup:
        def chosen(key: str) -> Set:
            joint = int(key)
            # The joint that stands on the other side changes places with this one.
            other = pair[side] if joint == pair[1 - side] else pair[1 - side]
            return Set(Solve, "pair", (joint, other) if side == 0 else (other, joint))

        return form.select(which, f"{which.capitalize()} joint", names, str(pair[side]), chosen)

    both = choice(0, "first"), tag("i", "and"), choice(1, "second"), tag("i", "the others are at rest")
    return row("Joints", both)


def maps_markup(form: Form, state: State, found: Square, units: Units) -> Markup:
    """Return the torus, if both joints turn, and the square."""
    said = "singular everywhere" if found.always else "red: det J = 0"
    press = tag("small", f"{said}; drag in it to move the arm⟦ (5.44–5.46)⟧")
    drawn = square_markup(form.place("square", _in_square, drag=True), state, found, units)
    if not state[Joints].arm.revolute[list(state[Solve].pair)].all():
        return joined(tag("h3", "Joint space ", press), drawn)
    torus = torus_markup(form.place("torus", _on_torus, drag=True), found)
    return joined(tag("h3", "Joint space, the torus S¹ × S¹ ", press), torus, tag("h3", "Cut open"), drawn)


def _go(across: float, up: float, drag: int) -> StandAt:
    """Return the command that moves the arm to a place in the square, in parts of its sides from the lower left."""
    return DragTo(across, up, drag) if drag else StandAt(across, up)


def _in_square(x: float, y: float, drag: int) -> StandAt:
    return _go(x, 1.0 - y, drag)


def _on_torus(x: float, y: float, drag: int) -> Wish:
    """Return the command that moves the arm to a place on the torus; nothing for a press beside it."""
    angles = pressed(x, y)
    if angles is None:
        return ()
    across, up = (0.5 + angle / math.tau for angle in angles)
    return _go(across, up, drag)


def norm_markup(state: State, units: Units) -> Markup:
    """Return the curve of the norm, with the point of the arm on it."""
    found, curve = flat(state), norm_curve(state)
    sigma, regular = found.answer.spaces.sigma, found.answer.spaces.rank == 2
    determinant = small(found.determinant) if regular else "0"
    ratio = small(float(sigma[1] / sigma[0])) if regular else "0"
    here = found.determinant, float(np.linalg.norm(found.answer.qdot)) if found.answer.verdict == "one" else math.inf
    second = units.variable(state[Solve].pair[1], bool(state[Joints].arm.revolute[state[Solve].pair[1]]))
    said = (
        f"Here det J = {determinant} m², ",
        with_indices("σ_min/σ_max"),
        f" = {ratio}. The ratio tells how near a singularity is; det J alone does not, it changes with the unit "
        "of length.",
    )
    aside = tag("small", f"while {second} goes through its range⟦ (1.20–1.24)⟧")
    return joined(tag("h3", "‖q̇‖ against det J ", aside), norm_svg(curve, here, units), tag("p.dim", said))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the page."""
    return PicturesPage(gui, state, post).show


PANEL = Panel((Joints, Solve), build)
