"""The planning steps in the scene: knots, path, samples, arms at some of them, and the resulting path of the tool."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.plan.state import Plan
from armlab.benches.motion.steps.state import INVERSE, JOINTS, PATH, SAMPLING, PlanSteps
from armlab.benches.motion.steps.worked import UNSEEN, Steps, kept, steps
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREY, PURPLE, SKY, VERDICT, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._line_nodes import Dots, Frames, Lines, Mark
from armlab.ui.scene._sticks import corners_of
from armlab.ui.scene._strokes import Segments, dashes, polyline
from armlab.ui.units import units_of

WANTED, RESULT = BLUE, PURPLE
"""Colours of the path, and of the path of the tool when the joints are interpolated."""

SAMPLE_COLOURS: dict[Feasible, Rgb] = {
    Feasible.YES: VERDICT["ok"],
    Feasible.NEAR_SINGULAR: VERDICT["warn"],
    Feasible.NOT_REACHED: VERDICT["no"],
}

PATH_THICK, RESULT_THICK, ARM_THICK, GAP_THICK = 0.0035, 0.0065, 0.0045, 0.004
KNOT, FEW, MANY, STOP = 0.009, 0.011, 0.0045, 0.018
"""Diameters of knots, of few and of many samples, and of a stop, in sizes of the arm."""

DENSE = 40
"""Number of samples from which on their points are small."""

DASHES = 24
"""Number of dashes of each straight line between two knots of a joint move."""

Floats = NDArray[np.float64]


class _Steps:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._knots = Dots(canvas, "motion_steps/knots", GREY)
        self._frames = Frames(canvas, "motion_steps/knot")
        self._path = Lines(canvas, "motion_steps/path", WANTED, PATH_THICK)
        self._samples = Dots(canvas, "motion_steps/samples", SKY)
        self._solved = {
            worth: Dots(canvas, f"motion_steps/{worth.name.lower()}", colour)
            for worth, colour in SAMPLE_COLOURS.items()
        }
        self._arms = Lines(canvas, "motion_steps/arms", GREY, ARM_THICK)
        self._stop = Mark(canvas, "motion_steps/stop", VERDICT["no"], STOP, "bottom-left")
        self._result = Lines(canvas, "motion_steps/result", RESULT, RESULT_THICK)
        self._gap = Lines(canvas, "motion_steps/gap", VERDICT["no"], GAP_THICK)
        self._worst = Mark(canvas, "motion_steps/worst", RESULT, 0.5 * STOP, "top-left")
        self._looked: Steps | None = None
        self._shown: object = None

    def show(self, state: State) -> None:
        """Show the steps up to the chosen one."""
        found = self._looked = kept(state.derived(steps), self._looked)
        shown = (found, state[PlanSteps].shown, state[Notation])
        if shown == self._shown:
            return
        self._shown = shown
        step = state[PlanSteps].shown if found is not None else 0
        self._show_knots(found)
        self._path.show(None if found is None else _path(found, step))
        self._show_samples(found, step)
        self._arms.show(None if found is None or step < INVERSE else _sticks(found))
        self._show_stop(found if step >= INVERSE else None)
        self._show_result(found if step >= JOINTS else None, state)

    def _show_knots(self, found: Steps | None) -> None:
        poses = np.zeros((0, 4, 4)) if found is None else found.knot_poses
        first = 0 if found is None else found.stretch.first
        self._frames.show(poses, [f"knot {first + k + 1}" for k in range(len(poses))])
        self._knots.show(poses[:, :3, 3], KNOT)

    def _show_samples(self, found: Steps | None, step: int) -> None:
        """Show the samples, from the inverse kinematics on in the colours of its results."""
        points = None if found is None or step < SAMPLING else found.samples
        size = FEW if points is not None and len(points) <= DENSE else MANY
        self._samples.show(points if step == SAMPLING else None, size)
        for worth, dots in self._solved.items():
            there = found is not None and points is not None and step >= INVERSE
            dots.show(points[found.worth == worth] if there else None, size)  # type: ignore[index, union-attr]

    def _show_stop(self, found: Steps | None) -> None:
        stops = () if found is None or found.followed is None else found.followed.stops
        if stops:
            self._stop.show(stops[0].point, f"✕ ends at s = {stops[0].s:.3f}")
        else:
            self._stop.show(None)

    def _show_result(self, found: Steps | None, state: State) -> None:
        """Show the path of the tool, and the point where it is farthest from the wanted path."""
        apart = None if found is None else found.apart
        if found is None or apart is None:
            self._result.show(None)
            self._gap.show(None)
            self._worst.show(None)
            return
        k, way = apart.worst, apart.wanted + found.larger * (apart.tool - apart.wanted)
        self._result.show(polyline(way if found.in_space else apart.tool))
        told = apart.distance[k] >= UNSEEN * found.arm.length_scale
        self._gap.show(polyline(np.stack([apart.wanted[k], way[k]])) if told else None)
        much = f", drawn × {found.larger:g}" if found.larger > 1.0 else ""
        distance = units_of(state).length(float(apart.distance[k]))
        self._worst.show(way[k] if told else None, f"{distance} apart{much}")


def _path(found: Steps, step: int) -> Segments | None:
    """Return the path in space; for a joint move, from the last step on, the straight lines for comparison."""
    if found.in_space:
        return polyline(found.drawn) if step >= PATH and found.way is not None else None
    if step < JOINTS:
        return None
    corners = found.drawn
    return np.concatenate([dashes(a, b, DASHES) for a, b in pairwise(corners)])


def _sticks(found: Steps) -> Segments | None:
    """Return the arm in a few configurations, as thin lines."""
    if not found.shown_arms:
        return None
    q = np.array([q for _, q in found.shown_arms])
    return np.concatenate([polyline(corners) for corners in corners_of(found.arm, q)])


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the steps while their page is open."""
    return _Steps(canvas).show


LAYER = Layer(
    "motion_steps", order=88, watches=(Plan, PlanSteps, RobotPart, Notation), build=build, panel="motion_steps"
)
