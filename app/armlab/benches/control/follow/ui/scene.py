"""The runs of kinematic control in the scene: wanted and driven paths, the arm at some instants, the present error."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.clip import time_of
from armlab.benches.control.follow.runs import Outcome
from armlab.benches.control.follow.state import CLIP_KEY, Control, questions, standing_start
from armlab.kin.arm import Arm
from armlab.kin.control.record import Run
from armlab.session.arm_on_clip import standing
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREY, RUN_COLOURS, VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._line_nodes import Dots, Lines, Mark
from armlab.ui.scene._nodes import add_triad, put, seen
from armlab.ui.scene._polyline import ROUGHNESS, simplified
from armlab.ui.scene._sticks import Stick, corners_of
from armlab.ui.scene._strokes import Segments, polyline
from armlab.ui.units import units_of

WANTED, DRIVEN, STROBE, ERROR = 0.0035, 0.006, 0.0022, 0.005
"""Thickness of the wanted path, driven paths, the arm at some instants, and the error, in sizes of the arm."""

AIM, PUSHED = 0.018, 0.016
"""Diameters of the wanted point and of the places of pushes, in sizes of the arm."""

FLASHES = 9
"""Number of instants at which the arm of the selected run is drawn."""

LEAST = 0.01
"""Shortest error that is drawn, in sizes of the arm."""

PALE = 0.0045
"""Thickness of the arm at the start, in sizes of the arm."""

Floats = NDArray[np.float64]


class _Runs:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._arm, self._size = canvas.drawn.figure.anatomy.arm, canvas.size
        self._wanted = Lines(canvas, "control/wanted", BLUE, WANTED)
        self._driven = [Lines(canvas, f"control/run{k}", colour, DRIVEN) for k, colour in enumerate(RUN_COLOURS)]
        self._strobe = Lines(canvas, "control/strobe", GREY, STROBE)
        self._others = [Stick(canvas, f"control/arm{k}", colour) for k, colour in enumerate(RUN_COLOURS)]
        self._start = Stick(canvas, "control/start", GREY, PALE)
        self._aim = Mark(canvas, "control/aim", BLUE, AIM, "top-left")
        self._error = Lines(canvas, "control/error", VERDICT["no"], ERROR)
        self._pushed = Dots(canvas, "control/pushed", VERDICT["warn"])
        self._target = add_triad(canvas.scene, canvas.path("control/target"), 0.8 * canvas.size)
        self._shown: tuple[Outcome | None, ...] = ()

    def show(self, state: State) -> None:
        """Show a state."""
        part = state[Control]
        outcomes = [part.outcomes.get(run.colour) for run in part.runs]
        drawn = (part.outcome, *outcomes)
        if drawn != self._shown:
            self._shown = drawn
            self._show_ways(state)
        regulates = part.run.reference == "target"
        seen(self._target, regulates)
        if regulates:
            put(self._target, part.target)
        self._show_present(state)

    def _show_ways(self, state: State) -> None:
        part = state[Control]
        ways: dict[int, Run | None] = {
            run.colour: _run_of(part.outcomes.get(run.colour), self._arm) for run in part.runs
        }
        for colour, lines in enumerate(self._driven):
            run = ways.get(colour)
            lines.show(None if run is None or run.steps == 0 else self._line(run.p))
        run = ways.get(part.run.colour)
        if run is None or run.steps == 0:
            for nodes in (self._wanted, self._strobe):
                nodes.show(None)
            self._pushed.show(None)
            return
        self._wanted.show(self._line(run.p_wanted) if np.ptp(run.p_wanted, axis=0).max() > 0.0 else None)
        times = np.linspace(0.0, run.duration, FLASHES)
        self._strobe.show(np.concatenate([polyline(each) for each in _corners(self._arm, run, times)]))
        self._pushed.show(np.array([run.p[run.index(time)] for time in run.pushed]).reshape(-1, 3), PUSHED)

    def _line(self, points: Floats) -> Segments:
        return polyline(points[simplified(points, ROUGHNESS * self._size)])

    def _show_present(self, state: State) -> None:
        """Show the points of the other runs at the present time, and the error of the selected one."""
        part, on, time = state[Control], state[Timeline].clip == CLIP_KEY, time_of(state)
        current = state.derived(questions)
        there = {run.colour: part.outcomes.get(run.colour) for run in part.runs}
        for colour, stick in enumerate(self._others):
            run = _run_of(there.get(colour), self._arm)
            played = colour == part.run.colour
            q = run.at(time) if on and run is not None else None
            stick.show(None if q is None or (played and self._stands(q)) else q)
        outcome = part.outcome
        run = _run_of(outcome, self._arm)
        stale = outcome is None or outcome.question != current[part.selected]
        self._start.show(None if on or (run is not None and not stale) else standing_start(state))
        self._show_error(state, run if on else None, time)

    def _show_error(self, state: State, run: Run | None, time: float) -> None:
        if run is None:
            self._aim.show(None)
            self._error.show(None)
            return
        k = run.index(time)
        tool, wanted = np.asarray(self._arm.position(run.at(time)), dtype=np.float64), _wanted_at(run, time)
        units, far = units_of(state), float(run.error_position[k])
        shown = far > LEAST * self._size and bool(self._arm.task.position)
        self._aim.show(wanted, f"wanted, error {units.length(far)}" if shown else "")
        self._error.show(polyline(np.array([tool, wanted])) if shown else None)

    def _stands(self, q: Floats) -> bool:
        """Return whether the arm can take a configuration, so that it shows the run itself."""
        apart = standing(self._arm, q) - q
        turned = np.where(self._arm.revolute, np.abs(2.0 * np.sin(0.5 * apart)), np.abs(apart))
        return bool(turned.max() <= 1e-6)


def _run_of(outcome: Outcome | None, arm: Arm) -> Run | None:
    """Return the run of an outcome if it belongs to this arm."""
    return None if outcome is None or outcome.question.arm is not arm else outcome.run


def _corners(arm: Arm, run: Run, times: Floats) -> Floats:
    return corners_of(arm, np.array([run.at(float(time)) for time in times]))


def _wanted_at(run: Run, time: float) -> Floats:
    """Return the wanted point at a time, (3,), by linear interpolation."""
    return np.array([np.interp(time, run.t, run.p_wanted[:, axis]) for axis in range(3)])


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the runs while their page is open."""
    return _Runs(canvas).show


LAYER = Layer("control", order=88, watches=(Control, Timeline, Joints, Notation), build=build, panel="control")
