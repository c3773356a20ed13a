"""The path of the tool in the planned motion, coloured by feasibility, with words where it cannot be run."""

from __future__ import annotations

import itertools

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.motion.plan.question import Feasible, Leg, Planned
from armlab.benches.motion.plan.state import Plan, last_planned
from armlab.benches.motion.plots.drawn import compared
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import BLUE, VERDICT, Rgb, line_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move
from armlab.ui.scene._polyline import ROUGHNESS, simplified
from armlab.ui.scene._strokes import add_name, polyline

PANELS = ("motion", "motion_pick", "motion_plots", "motion_files")

THICKNESS, OTHER = 0.0065, 0.003
"""Thickness of the path, and of the one for comparison, in sizes of the arm."""

MARK = 0.013
"""Radius of the mark at the end of a path that cannot be run, in sizes of the arm."""

COLOURS: dict[Feasible, Rgb] = {
    Feasible.YES: BLUE,
    Feasible.NEAR_SINGULAR: VERDICT["warn"],
    Feasible.OVER_LIMIT: VERDICT["no"],
    Feasible.NOT_REACHED: VERDICT["no"],
}

OTHER_COLOUR: Rgb = (150, 120, 190)

WORDS = {"reach": "out of reach", "limit": "joint {} at its limit", "singularity": "singular", "branch": "branch ends"}


class _Ways:
    """The paths of a planned motion, whose nodes are rebuilt when there is another one."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._nodes: list[viser.SceneNodeHandle] = []
        self._shown: tuple[Planned | None, Planned | None] = None, None

    def show(self, state: State) -> None:
        """Show the motion planned last, and the one for comparison."""
        part, planned = state[Plan], last_planned(state)
        other = None if planned is None or not part.compared else compared(state, planned)
        if self._shown[0] is planned and self._shown[1] is other:
            return
        self._shown = planned, other
        for node in self._nodes:
            node.remove()
        self._nodes = []
        if other is not None and planned is not None:
            self._draw(other, "other", OTHER)
        if planned is not None:
            self._draw(planned, "way", THICKNESS)
            self._mark(planned)

    def _draw(self, planned: Planned, name: str, thickness: float) -> None:
        legs = [leg for leg in planned.legs if len(leg.points) > 1]
        if not legs:
            return
        lines = [_drawn(leg, ROUGHNESS * self._canvas.size) for leg in legs]
        segments = np.concatenate([polyline(points) for points, _ in lines])
        worth = np.concatenate([worth for _, worth in lines])
        colours = _colours(worth, name == "other")
        node = self._canvas.scene.add_line_segments(
            self._canvas.path(f"motion/{name}"), segments, colours, thickness=thickness * self._canvas.size
        )
        self._nodes.append(node)

    def _mark(self, planned: Planned) -> None:
        """Write the reason at the end of the path, because a colour alone has no meaning."""
        scene, size = self._canvas.scene, self._canvas.size
        stops = [stop for leg in planned.legs if leg.followed is not None for stop in leg.followed.stops[:1]]
        for k, stop in enumerate(stops):
            path = self._canvas.path(f"motion/stop{k}")
            node = scene.add_icosphere(
                path, MARK * size, VERDICT["no"], subdivisions=2, cast_shadow=False, receive_shadow=False
            )
            move(node, stop.point)
            self._nodes.append(node)
            words = WORDS[stop.kind].format(stop.joint)
            add_name(scene, f"{path}/words", f"✕ {words}", np.zeros(3), "bottom-left")  # goes with the mark


def _drawn(leg: Leg, tolerance: float) -> tuple[NDArray[np.float64], NDArray[np.int_]]:
    """Return the points (k+1, 3) with which a leg is drawn, and the feasibility of each segment between them, (k,)."""
    worth = np.maximum(leg.worth[1:], leg.worth[:-1])
    ends = [0, *(np.flatnonzero(np.diff(worth)) + 1), len(worth)]
    runs = [first + simplified(leg.points[first : last + 1], tolerance) for first, last in itertools.pairwise(ends)]
    starts = np.concatenate([run[:-1] for run in runs])
    return leg.points[[*starts, len(worth)]], worth[starts]


def _colours(worth: NDArray[np.int_], other: bool) -> NDArray[np.uint8]:
    """Return the colours of the ends of segments, (k, 2, 3)."""
    table = np.array([line_colour(OTHER_COLOUR if other else COLOURS[each]) for each in Feasible], dtype=np.uint8)
    return np.repeat(table[worth][:, None], 2, axis=1)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the path while a page of the motion is open."""
    return _Ways(canvas).show


LAYER = Layer("motion_path", order=87, watches=(Plan, RobotPart), build=build, panel=PANELS)
