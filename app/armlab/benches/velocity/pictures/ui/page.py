"""Two joints of a plane arm in pictures: two lines, the norm against det J, and the torus of joint values cut open."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.velocity.solve.pictures import DragTo, Square, StandAt, flat, key_of, norm_curve, refusal, square
from armlab.benches.velocity.solve.state import PicturePair, Solve
from armlab.benches.velocity.solve.ui.pictures import lines_svg, lines_words, marks_style, norm_svg, square_markup
from armlab.benches.velocity.solve.ui.torus import pressed, torus_markup, torus_style
from armlab.benches.velocity.solve.ui.words import card, small
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.format import escaped, mathml
from armlab.ui.markup import options, row, select
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


class PicturesPage:
    """The page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._state, self._post, self._units = state, post, units_of(state)
        self._head: Fields = gui.fields(lambda cell, text: self._typed(self._head, cell, text))
        self._lines = gui.html()
        self._map: Fields = gui.fields(lambda cell, text: self._typed(self._map, cell, text))
        self._mark = gui.html()
        self._norm = gui.html()
        self._drawn: object = None

    def _typed(self, fields: Fields, cell: str, text: str) -> None:
        present = self._state
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, self._post):
            self.show(present)

    def show(self, state: State) -> None:
        """Show a state; the square is sent only when its singular set is another one."""
        self._state = state
        self._head.show(_head(self._head, state, self._units))
        why = refusal(state)
        for element in (self._lines, self._mark, self._norm):
            element.visible(not why)
        if why:
            self._drawn = why
            self._map.show(card("warn", "No pictures", why))
            return
        units, found = self._units, flat(state)
        equation = mathml(r"J\dot q=v")
        title = f"<h3>Two lines {equation} <small>(1.18–1.24); rows of J, not columns</small></h3>"
        self._lines.show(title + lines_svg(state, found, units) + lines_words(state, found, units))
        place = square(state)
        key = key_of(state)
        if key != self._drawn or self._map.stale:
            self._drawn = key
            self._map.show(_maps(self._map.channel_id, state, place, units))
        self._mark.show(marks_style(state, place, found) + torus_style(state, found))
        self._norm.show(_norm(state, units))


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what follows from a press or a choice."""
    pair = state[Solve].pair
    if cell in ("first", "second") and text.isdecimal():
        joint = int(text)
        if cell == "first":
            return (PicturePair(joint, pair[0] if joint == pair[1] else pair[1]),)
        return (PicturePair(pair[1] if joint == pair[0] else pair[0], joint),)
    if cell in ("square", "torus"):
        try:
            x, y, *drag = (float(part) for part in text.split(","))
        except ValueError:
            return ()
        place = _place(cell, x, y) if math.isfinite(x + y) else None
        if place is None:
            return ()
        return (DragTo(*place, int(drag[0])) if len(drag) == 1 and math.isfinite(drag[0]) else StandAt(*place),)
    return ()


def _place(cell: str, x: float, y: float) -> tuple[float, float] | None:
    """Return where in the square a hand points, in parts of it from the lower left corner; None beside the torus."""
    if cell == "square":
        return x, 1.0 - y
    angles = pressed(x, y)
    if angles is None:
        return None
    across, up = (0.5 + angle / math.tau for angle in angles)
    return across, up


def _head(fields: Fields, state: State, units: Units) -> str:
    """Return the choice of the two joints."""
    arm, (first, second) = state[Joints].arm, state[Solve].pair
    if arm.n < 3 or not arm.description.axes_parallel:
        return ""
    names = {str(k): units.variable(k, bool(arm.revolute[k])) for k in range(arm.n)}
    channel = fields.channel_id
    return row(
        "Joints",
        select(channel, "first", "First joint", options(names, str(first)))
        + "<i>and</i>"
        + select(channel, "second", "Second joint", options(names, str(second)))
        + "<i>the others stand still</i>",
    )


def _maps(channel: str, state: State, place: Square, units: Units) -> str:
    """Return the torus, where both joints turn, and the square."""
    said = "singular everywhere" if place.always else "red: det J = 0"
    press = f"<small>{said}; drag in it to move the arm (5.44–5.46)</small>"
    drawn = square_markup(channel, state, place, units)
    if not state[Joints].arm.revolute[list(state[Solve].pair)].all():
        return f"<h3>Joint space {press}</h3>{drawn}"
    return f"<h3>Joint space, the torus S¹ × S¹ {press}</h3>{torus_markup(channel, place)}<h3>Cut open</h3>{drawn}"


def _norm(state: State, units: Units) -> str:
    found, curve = flat(state), norm_curve(state)
    sigma = found.answer.spaces.sigma
    ratio = float(sigma[1] / sigma[0]) if sigma[0] > 0.0 else 0.0
    here = found.determinant, float(np.linalg.norm(found.answer.qdot)) if found.answer.verdict == "one" else math.inf
    second = units.variable(state[Solve].pair[1], bool(state[Joints].arm.revolute[state[Solve].pair[1]]))
    return (
        f"<h3>‖q̇‖ against det J <small>while {escaped(second)} goes through its range (1.20–1.24)</small></h3>"
        f"{norm_svg(curve, here, units)}"
        f'<p class="dim">Here det J = {small(found.determinant)} m², smallest σ : largest σ = {small(ratio)}. The '
        "ratio tells how near a singularity is; det J alone does not, it changes with the unit of length.</p>"
    )


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the page."""
    return PicturesPage(gui, state, post).show


PANEL = Panel((Joints, Solve), build)
