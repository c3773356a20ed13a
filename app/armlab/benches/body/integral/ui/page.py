"""The page of the integral of omega: two time laws, their integrals, and the orientations in which they end."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.body.forms.stage import around_both
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.integral.examples import EXAMPLES, ChooseIntegralExample, example_of
from armlab.benches.body.integral.film import (
    EQUAL,
    angles_over_time,
    apart,
    duration_of,
    film_time,
    integrals_apart,
    runs_of,
)
from armlab.benches.body.integral.state import ABOUT, CLIP_KEY, Integral
from armlab.benches.body.integral.ui.laws import laws_markup
from armlab.benches.body.integral.ui.scene import COLOURS
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import AXES, css
from armlab.ui.examples import examples
from armlab.ui.format import dot, matrix, number, pairs
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.playing import clock
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HEIGHT = 118

EN_SPACE = "\N{EN SPACE}"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the laws, the clock, integrals and orientations, and the plots of omega and of the angle of R."""
    form, numbers = gui.form(post), gui.html()
    plots = _Plots(gui, state)

    def show(state: State) -> None:
        about = form.chips("about", ABOUT, state[Integral].about, "The axes of ω", partial(Set, Integral, "about"))
        form.show(
            examples(form, EXAMPLES, example_of(state), ChooseIntegralExample, said=units_of(state).said),
            laws_markup(form, state),
            row("ω along", about),
            clock(form, state, CLIP_KEY, duration_of(state), film_time(state)),
        )
        numbers.show(ends_markup(state))
        plots.show(state)

    return show


class _Plots:
    """The angle of R of both laws, and the three components of each omega over time."""

    def __init__(self, gui: Gui, state: State) -> None:
        units = units_of(state)
        self._factor = units.factor(True)
        both = [Curve(f"law {k + 1}", colour) for k, colour in enumerate(COLOURS)]
        title = f"Angle of R from the start, {units.angle_unit}"
        self._angle = Plot(gui, title, "t, s", both, "angle_of_R", height=HEIGHT, clip=CLIP_KEY)
        parts = [Curve(f"ω {axis}", colour) for axis, colour in AXES.items()]
        self._omegas = []
        with gui.fold("ω over time"):
            for k in range(2):
                named = f"ω of law {k + 1}, {units.angle_unit}/s"
                self._omegas.append(Plot(gui, named, "t, s", parts, f"omega_{k + 1}", height=HEIGHT, clip=CLIP_KEY))
        self._drawn: Integral | None = None

    def show(self, state: State) -> None:
        """Draw the curves of the laws; the cursor follows the film."""
        part = state[Integral]
        if part == self._drawn:
            return
        self._drawn = part
        times, angles = angles_over_time(state)
        self._angle.show(times, [angle / self._factor for angle in angles])
        for plot, run in zip(self._omegas, runs_of(state), strict=True):
            times, omega = run.omega()
            plot.show(times, [omega[:, k] / self._factor for k in range(3)])
        for plot in (self._angle, *self._omegas):
            plot.cursor(TIME)


def ends_markup(state: State) -> Inside:
    """Return both integrals and both orientations at the time of the film, and what follows from them."""
    units, time = units_of(state), film_time(state)
    halves = []
    for k, run in enumerate(runs_of(state)):
        head = tag("b", dot(css(COLOURS[k])), f"R of law {k + 1}")
        halves.append(tag("div", head, matrix(run.at(time), 3)))
    rows: list[tuple[Inside, Inside]] = [
        (f"∫ω dt of law {k + 1}, {units.angle_unit}", _three(run.integral(time), units))
        for k, run in enumerate(runs_of(state))
    ]
    rows.append(("angle between the bodies", units.angle(apart(state, time))))
    head = tag("h3", f"After {number(time, 2)} s", tag("small", " beginning with R = I"))
    return head, tag("div.in-both", halves), pairs(rows), _verdict(state, time, units)


def _verdict(state: State, time: float, units: Units) -> Markup | None:
    if time < duration_of(state):
        return None
    angle, difference = apart(state, time), integrals_apart(state, time)
    if difference > EQUAL:
        said = f"The integrals differ by up to {units.angle(difference)} in a component, the ends by "
        return tag("p.dim", said, units.angle(angle), ".")
    if angle > EQUAL:
        said = (
            "The integral of ω is no orientation: it adds turns about different axes as if their order did not "
            "matter⟦ (5.19–5.21)⟧. R is a product, one factor for each piece."
        )
        return verdict_box("warn", f"Equal integrals, ends {units.angle(angle)} apart", tag("p", said))
    return verdict_box("ok", "Equal integrals, and the bodies end alike", tag("p", _why(state)))


def _why(state: State) -> str:
    """Return why two laws with equal integrals end alike."""
    axes = np.vstack([run.rates for run in runs_of(state)])
    if np.linalg.matrix_rank(axes, tol=1e-9) <= 1:
        return "All pieces turn about one line: there the integral of ω is the angle."
    return "Here the pieces are the same, or happen to make the same product."


def _three(vector: np.ndarray, units: Units) -> str:
    return EN_SPACE.join(units.text(float(value), True) for value in vector)


PANEL = Panel((Integral, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=around_both)
