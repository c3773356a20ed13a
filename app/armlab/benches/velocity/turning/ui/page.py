"""The page of turning: three angles and their rates against omega, and why omega cannot be integrated."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.motion.api import sphere_of
from armlab.benches.velocity.speeds.state import Velocity
from armlab.benches.velocity.turning.motion import film_time, laws_time, turned_of
from armlab.benches.velocity.turning.state import CLIP_KEY, MATRIX, Turning
from armlab.benches.velocity.turning.ui.numbers import (
    columns_markup,
    columns_of,
    form_markup,
    laws_markup,
    rates_markup,
    small_markup,
    tool_markup,
    views_markup,
)
from armlab.benches.velocity.turning.ui.scene import OMEGA
from armlab.kin.velocity.rates import rate_determinant
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Selection
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE
from armlab.ui.form import Form
from armlab.ui.format import mathml, number
from armlab.ui.html import Markup, joined, tag
from armlab.ui.matrices import MatrixView
from armlab.ui.playing import play_button
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.symbols import with_indices
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

ROWS = tuple(with_indices(f"ω_{axis}") for axis in "xyz")

TITLE = joined(mathml("T"), " ", tag("small", "columns are the axes of the turns, in the fixed axes"))

HEIGHT = 114
POINTS = 181


class _Second:
    """det T over the second angle, with a cursor at its present value."""

    def __init__(self, gui: Gui, state: State) -> None:
        units = units_of(state)
        self._factor = units.factor(True)
        name = f"second angle, {units.angle_unit}"
        with gui.fold("det T over the second angle") as self._fold:
            self._plot = Plot(gui, "det T", name, [Curve("det T", BLUE)], "det_T", height=HEIGHT)
        self._shown: tuple[str, bool] | None = None

    def show(self, state: State) -> None:
        """Show the curve of the sequence; only the cursor follows the angle."""
        part = state[Turning]
        self._fold.visible(part.shown == "angles")
        self._plot.visible(part.shown == "angles")
        if part.shown != "angles":
            return
        if self._shown != (part.axes, part.fixed):
            self._shown = part.axes, part.fixed
            middle = np.linspace(-math.pi, math.pi, POINTS)
            angles = np.stack([np.zeros(POINTS), middle, np.zeros(POINTS)], axis=1)
            self._plot.show(middle / self._factor, [rate_determinant(angles, part.axes, part.fixed)])
        now = float(state.derived(turned_of).angles[1])
        self._plot.cursor(math.remainder(now, 2.0 * math.pi) / self._factor)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the form, T, the numbers, the plot, and the two laws."""
    top, form = gui.form(post), gui.form(post)
    matrix = MatrixView(gui, post, MATRIX)
    numbers = gui.html()
    plot = _Second(gui, state)
    rest = gui.html()

    def show(state: State) -> None:
        angles = state[Turning].shown == "angles"
        top.show(views_markup(top, state), clock_markup(top, state))
        form.show(form_markup(form, state) if angles else None)
        matrix.visible(angles)
        if angles:
            matrix.show(state, TITLE, state.derived(turned_of).T, columns=columns_of(state), rows=ROWS)
        numbers.show((columns_markup(state), rates_markup(state)) if angles else None)
        plot.show(state)
        rest.show(tool_markup(state) if angles else (laws_markup(state), small_markup()))

    return show


def clock_markup(form: Form, state: State) -> Markup:
    """Return the button that plays, and the time of the film."""
    play = play_button(form, state, CLIP_KEY, "turning", "Turn", hint="Rotate the body beside the arm")
    time = laws_time(state) if state[Turning].shown == "laws" else film_time(state)
    return tag("div.bar", play, tag("span.dim", f"t = {number(time, 2)} s"))


def _around(state: State) -> Points:
    """Return a box around the body beside the arm."""
    centre, radius = sphere_of(state)
    return np.asarray(centre + OMEGA * radius * np.array([[1.0, 1, 1], [-1, -1, -1]]))


PANEL = Panel((Turning, Timeline, Selection, Joints, Velocity), build, rebuilds=(Notation,), around=_around)
