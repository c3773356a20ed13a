"""The plots of the runs: errors, joint speeds, joints, nearness to singularities, with a cursor at the time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.runs import Outcome, speed_limits
from armlab.benches.control.follow.state import CLIP_KEY, Control
from armlab.benches.control.follow.ui.form import sigma_unit
from armlab.kin.arm import Arm
from armlab.kin.control.record import Run
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import RUN_COLOURS, joint_colour
from armlab.ui.format import mathml
from armlab.ui.html import Inside, tag
from armlab.ui.plot import NOTHING, TIME, Curve, Plot
from armlab.ui.run_plot import ROOM, RunPlot
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

VIEWS = {"error": "Errors", "speed": "Speeds", "joint": "Joints", "sigma": "σ, λ"}

POINTS = 601
"""Number of points of a curve that shares its abscissa with those of other runs."""

HEIGHT = 118

Array = NDArray[np.float64]


class JointPlot(Plot):
    """One quantity of the selected run, with a curve for each joint of one kind."""

    def __init__(self, gui: Gui, arm: Arm, units: Units, turns: bool, quantity: tuple[Inside, str, str]) -> None:
        name, suffix, file = quantity
        self.joints = np.flatnonzero(arm.revolute == turns)
        self._unit_size = units.factor(turns)
        unit = f"{units.unit(turns)}{suffix}"
        curves = [Curve(f"joint {i + 1}, {unit}", joint_colour(int(i))) for i in self.joints]
        mixed = bool(arm.revolute.any()) and not bool(arm.revolute.all())
        kind = (" of revolute joints" if turns else " of prismatic joints") if mixed else ""
        title = tag("span", name, f"{kind}, {unit}")
        super().__init__(gui, title, "t, s", curves, file, limits=2, height=HEIGHT, clip=CLIP_KEY)

    def show_joints(self, run: Run, values: Array, limit: float | None = None) -> None:
        """Show values (k, n) of a run, between plus and minus a limit if there is one."""
        curves = [values[:, i] / self._unit_size for i in self.joints]
        lines = () if limit is None else (limit / self._unit_size, -limit / self._unit_size)
        # The page cannot choose a range where a limit is left out.
        every = np.concatenate([*curves, np.array(lines)])
        low, high = float(every.min()), float(every.max())
        room = ROOM * (high - low) if high - low > NOTHING else 0.5
        scales = {"x": {"time": False}, "y": {"range": (low - room, high + room)}}
        if self._handle.scales != scales:
            self._handle.scales = scales
        self.show(run.t, curves, lines)


class Plots:
    """All plots, of which those of one view are visible."""

    def __init__(self, gui: Gui, state: State) -> None:
        arm, units = state[Joints].arm, units_of(state)
        self._arm, self._units = arm, units
        self._view, self._shown = "error", object()
        self._across: dict[str, list[RunPlot]] = {"error": [], "speed": [], "joint": [], "sigma": []}
        self._each: dict[str, list[JointPlot]] = {"error": [], "speed": [], "joint": [], "sigma": []}
        kinds = [turns for turns in (True, False) if bool(np.any(arm.revolute == turns))]
        self._make_errors(gui, kinds)
        for turns in kinds:
            self._each["speed"].append(JointPlot(gui, arm, units, turns, (("Speeds ", mathml(DOT)), "/s", "speeds")))
        which = "joint" if len(kinds) == 1 else "revolute joint"
        fastest = f"Fastest {which} of all runs, {units.unit(kinds[0])}/s"
        self._across["speed"].append(RunPlot(gui, fastest, "fastest", self._fastest(kinds[0]), True, clip=CLIP_KEY))
        for turns in kinds:
            self._each["joint"].append(JointPlot(gui, arm, units, turns, ("Joint values", "", "joints")))
        sigma = sigma_unit(arm)
        smallest = "Smallest singular value ", mathml(SIGMA), f", {sigma}" if sigma else None
        self._across["sigma"] = [
            RunPlot(gui, smallest, "sigma_min", _of(lambda run: run.sigma_min), True, clip=CLIP_KEY),
            RunPlot(
                gui,
                f"Damping λ{f', {sigma}²' if sigma else ''}",
                "damping",
                _of(lambda run: run.damping),
                True,
                clip=CLIP_KEY,
            ),
        ]

    def _make_errors(self, gui: Gui, kinds: Sequence[bool]) -> None:
        arm, units = self._arm, self._units
        if arm.task.position:
            metre = units.factor(False)
            title = f"Error of the position, {units.length_unit}"
            self._across["error"].append(
                RunPlot(gui, title, "position_error", _of(lambda r: r.error_position / metre), True, clip=CLIP_KEY)
            )
        if arm.task.rotation != "none":
            radian = units.factor(True)
            title = f"Error of the orientation, {units.angle_unit}"
            self._across["error"].append(
                RunPlot(gui, title, "orientation_error", _of(lambda r: r.error_rotation / radian), True, clip=CLIP_KEY)
            )
        for turns in kinds:
            quantity = ("Errors ", mathml(GAP)), "", "joint_errors"
            self._each["error"].append(JointPlot(gui, arm, units, turns, quantity))
        unit = units.length_unit
        curves = [Curve(f"the run, {unit}", RUN_COLOURS[0]), Curve(f"predicted, {unit}", RUN_COLOURS[1], dash=(5, 4))]
        both = "Error of the position, and ", mathml(PREDICTED), f", {unit}"
        self._prediction = Plot(gui, both, "t, s", curves, "prediction", height=HEIGHT, clip=CLIP_KEY)

    def _fastest(self, turns: bool) -> Callable[[Any], Array]:
        joints, factor = self._arm.revolute == turns, self._units.factor(turns)
        return _of(lambda run: np.abs(run.qdot[:, joints]).max(axis=1) / factor)

    def look_at(self, view: str) -> None:
        """Make the plots of another view visible from the next `show` on."""
        self._view, self._shown = view, object()

    def show(self, state: State) -> None:
        """Show the curves of a state if they have changed; the cursor follows the run that plays."""
        part = state[Control]
        shown = (tuple(part.outcomes.get(run.colour) for run in part.runs), part.selected, self._view)
        if shown != self._shown:
            self._shown = shown
            self._draw(state)
        at = TIME if state[Timeline].clip == CLIP_KEY else None
        for view in VIEWS:
            for plot in (*self._across[view], *self._each[view]):
                if view == self._view:
                    plot.cursor(at)
        if self._view == "error":
            self._prediction.cursor(at)

    def _draw(self, state: State) -> None:
        part = state[Control]
        outcome, run = part.outcome, None if part.outcome is None else part.outcome.run
        for view in VIEWS:
            on = view == self._view and run is not None
            for plot in self._across[view]:
                plot.visible(on)
            for each in self._each[view]:
                each.visible(on and not (view == "error" and (run is None or run.error_joint is None)))
        predicted = None if outcome is None or self._view != "error" else outcome.predicted
        self._prediction.visible(predicted is not None)
        if run is None or outcome is None:
            return
        if predicted is not None:
            metre = self._units.factor(False)
            self._prediction.show(run.t, [run.error_position / metre, predicted / metre])
        self._draw_runs(state)
        self._draw_joints(run, outcome)

    def _draw_runs(self, state: State) -> None:
        part = state[Control]
        by_colour: list[Run | None] = [None] * len(RUN_COLOURS)
        for each in part.runs:
            outcome = part.outcomes.get(each.colour)
            by_colour[each.colour] = None if outcome is None else outcome.run
        end = max((run.duration for run in by_colour if run is not None), default=1.0) or 1.0
        grid = np.linspace(0.0, end, POINTS)
        for plot in self._across[self._view]:
            plot.name_x("t, s")
            plot.show_runs(grid, [None if run is None else _on(grid, run, plot.values) for run in by_colour])

    def _draw_joints(self, run: Run, outcome: Outcome) -> None:
        setup = outcome.question.setup
        for each in self._each[self._view]:
            if self._view == "joint":
                each.show_joints(run, run.q)
            elif self._view == "error" and run.error_joint is not None:
                each.show_joints(run, run.error_joint)
            elif self._view == "speed":
                limits = set(speed_limits(self._arm, setup)[each.joints].tolist())
                # One line stands for all of them only where they are equal.
                limit = limits.pop() if len(limits) == 1 and setup.saturation != "none" else np.inf
                each.show_joints(run, run.qdot, limit if np.isfinite(limit) else None)


DOT, SIGMA, GAP, PREDICTED = r"\dot q", r"\sigma_{min}", r"q_d-q", r"\dot e_p=-JKJ^{\#}e_p"


def _of(values: Callable[[Run], Array]) -> Callable[[Any], Array]:
    return values


def _on(grid: Array, run: Run, values: Callable[[Any], Array | None]) -> Array | None:
    """Return a curve of a run on the shared abscissa, NaN after the end of the run."""
    curve = values(run)
    if curve is None:
        return None
    found = np.interp(grid, run.t, curve, right=np.nan)
    # The largest value must not fall between two points of the grid.
    top = int(np.argmax(curve))
    found[int(np.argmin(np.abs(grid - run.t[top])))] = curve[top]
    return found
