"""The plots of the planning steps: singular values, joint values with the samples, and the deviation of the tool."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.ui.joint_marks import joint_dash, joint_dots, joint_mark
from armlab.benches.motion.steps.state import INVERSE, JOINTS, PlanSteps
from armlab.benches.motion.steps.worked import Steps
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import BLUE, PURPLE, joint_colour
from armlab.ui.columns import csv_of
from armlab.ui.format import trimmed
from armlab.ui.html import Inside, tag
from armlab.ui.plot import NOTHING, Curve, Plot
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HEIGHT, TALL = 104, 146
"""Height of plots with one curve, and of those with all joints, pixels."""

ROOM = 0.08
"""Room above and below the curves, relative to their extent."""

MARKED = 61
"""Number of samples up to which each is marked on the curves; more of them cannot be told apart."""

LARGE, SMALL = 6.0, 3.0
"""Diameter of the dots of few and of many samples, pixels."""

APART = 1e-6
"""Distance, metres, below which a curve is drawn as zero: it comes from rounding in the inverse kinematics."""

AT_SAMPLE = 1e-9
"""Difference in s up to which a place is that of a sample."""

Array = NDArray[np.float64]


class StepPlot(Plot):
    """A plot over s from 0 to 1."""

    def __init__(self, gui: Gui, title: Inside, curves: Sequence[Curve], file: str, height: int, zero: bool) -> None:
        self._zero = zero
        super().__init__(gui, title, "s", curves, file, height=height, legend=False)

    def show_over(self, s: Array, curves: Sequence[Array], least: float = 0.0) -> None:
        """Show curves, which are drawn as zero if none exceeds ``least``.

        The page cannot choose the ranges where curves have gaps.
        """
        values = np.concatenate(curves)
        values = values[np.isfinite(values)]
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
        low = 0.0 if self._zero else low
        high = 0.0 if max(-low, high) < least else high
        room = ROOM * (high - low) if high - low > NOTHING * max(1.0, abs(high)) else 0.5
        y = {"range": (low if self._zero else low - room, high + room)}
        scales = {"x": {"time": False, "range": (0.0, 1.0)}, "y": y}
        if self._handle.scales != scales:
            self._handle.scales = scales
        self.show(s, curves)


class JointPlot(StepPlot):
    """A plot of joint values of one kind over s: the samples as dots, and the curves between them."""

    def __init__(self, gui: Gui, state: State, turns: bool) -> None:
        arm, units = state[Joints].arm, units_of(state)
        self._which = np.flatnonzero(arm.revolute == turns)
        self._factor = units.factor(turns)
        self._names = {int(i): units.variable(int(i), turns) for i in self._which}
        self._unit = units.unit(turns)
        legend = tag("span.ms-legend", [tag("span", joint_mark(i), name) for i, name in self._names.items()])
        kind = "Revolute" if turns else "Prismatic"
        title = (tag("span", f"{kind} joints, {self._unit}"), legend)
        super().__init__(gui, title, self._lines(), f"{kind.lower()}_joints_over_s", TALL, False)

    def _lines(self) -> list[Curve]:
        return [Curve(f"{name}, {self._unit}", joint_colour(i), dash=joint_dash(i)) for i, name in self._names.items()]

    def _dots(self, size: float) -> list[Curve]:
        return [joint_dots(i, f"{name}, {self._unit}", size) for i, name in self._names.items()]

    def show_samples(self, s: Array, q: Array) -> None:
        """Show samples (k, n) at s (k,) alone."""
        self.announce(self._dots(dot_size(len(s))))
        self.show_over(s, list(self._values(q)))

    def show_path(self, s: Array, q: Array, samples: Array) -> None:
        """Show a path by its values (k, n) at s (k,), with dots at those s that are samples, if these are few."""
        values = self._values(q)
        if len(samples) > MARKED:
            self.announce(self._lines())
            self.show_over(s, list(values))
            return
        at_sample = np.abs(s[:, None] - samples).min(axis=1) < AT_SAMPLE
        self.announce([*self._lines(), *self._dots(LARGE)])
        self.show_over(s, [*values, *np.where(at_sample, values, np.nan)])

    def _values(self, q: Array) -> Array:
        return (q[:, self._which] / self._factor).T

    def csv(self) -> str:
        """Return the values without the dots on the curves, which are repeated values."""
        count = len(self._which)
        return csv_of([self._x, *(curve.name for curve in self._curves[:count])], self._table[: 1 + count])


class Plots:
    """All plots, of which those of the step are visible."""

    def __init__(self, gui: Gui, state: State) -> None:
        unit = units_of(state).length_unit
        self._apart = StepPlot(gui, "", [Curve(f"apart, {unit}", PURPLE)], "apart_over_s", HEIGHT, True)
        revolute = state[Joints].arm.revolute
        self._joints = [JointPlot(gui, state, turns) for turns in (True, False) if bool(np.any(revolute == turns))]
        title = tag("span", with_indices("σ_min/σ_max"), " of the task Jacobian")
        self._sigma = StepPlot(gui, title, [_sigma(0)], "singular_values_over_s", HEIGHT, True)
        self._shown: object = None

    def show(self, found: Steps | None, state: State) -> None:
        """Show the plots of the step if they have changed."""
        step = state[PlanSteps].shown
        if (found, step) == self._shown:
            return
        self._shown = (found, step)
        self._show_apart(found if step == JOINTS else None, units_of(state))
        self._show_sigma(found if step == INVERSE else None)
        self._show_joints(found, step)

    def _show_apart(self, found: Steps | None, units: Units) -> None:
        apart = None if found is None else found.apart
        self._apart.visible(apart is not None)
        if apart is not None and found is not None:
            what = "the path" if found.in_space else "the straight lines"
            factor, unit = units.factor(False), units.length_unit
            tiny = float(apart.distance.max()) < APART
            said = f": less than {trimmed(APART / factor, 6)}" if tiny else ""
            self._apart.name(tag("span", f"Distance from {what}, {unit}{said}"))
            self._apart.show_over(apart.s, [apart.distance / factor], APART / factor)

    def _show_sigma(self, found: Steps | None) -> None:
        followed = None if found is None else found.followed
        self._sigma.visible(followed is not None)
        if followed is not None:
            self._sigma.announce([_sigma(len(followed.s))])
            self._sigma.show_over(followed.s, [followed.singular_value])

    def _show_joints(self, found: Steps | None, step: int) -> None:
        samples = None if found is None or step < INVERSE else _samples(found)
        apart = found.apart if found is not None and step == JOINTS else None
        seen = apart is not None or (samples is not None and step == INVERSE)
        for plot in self._joints:
            plot.visible(seen)
            if apart is not None and samples is not None:
                plot.show_path(apart.s, apart.q, samples[0])
            elif samples is not None and seen:
                plot.show_samples(*samples)


def dot_size(count: int) -> float:
    """Return the diameter of the dots for a number of samples, pixels."""
    return LARGE if count <= MARKED else SMALL


def _sigma(count: int) -> Curve:
    return Curve("ratio", BLUE, dot_size(count), dots=True)


def _samples(found: Steps) -> tuple[Array, Array] | None:
    """Return s (N,) and joint values (N, n) where the inverse kinematics was solved, or None."""
    if not found.in_space:
        return found.knot_places, found.knot_q
    return None if found.followed is None else (found.followed.s, found.followed.q)
