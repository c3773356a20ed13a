"""The positions of the visits about the goal, drawn larger than they are."""

from __future__ import annotations

from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.robot.taught.state import TaughtGoal
from armlab.benches.robot.taught.visits import Visits, visits_of
from armlab.session.parts.joints import Joints
from armlab.session.round_numbers import round_below
from armlab.session.state import State
from armlab.ui.colours import ORANGE, PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.plugin import Layer, Points, Show
from armlab.ui.scene._nodes import move, write

Floats = NDArray[np.floating]

DRAWN = 0.16
"""Distance of the farthest position from the goal in the scene, in sizes of the arm."""

LABEL = 0.05
"""Distance of the label from the goal and from what is drawn about it, in sizes of the arm."""

BESIDE = 0.25
"""Room on either side of the middle of the label, in sizes of the arm."""

DOT, BALL = 0.005, 0.011
"""Size of a position, and radius of the ball at the goal, in sizes of the arm."""


def factor_of(visits: Visits, size: float) -> float:
    """Return how many times as large deviations are drawn: a round number; 1 where there are none."""
    farthest = float(np.linalg.norm(visits.points - visits.goal, axis=1).max())
    return max(round_below(DRAWN * size / farthest), 1.0) if farthest > 0.0 else 1.0


def label_place(points: Floats, goal: Floats, wrist: Floats, size: float) -> Floats:
    """Return where the label stands: beyond the goal and the drawn positions (n, 3), away from the wrist."""
    around = np.vstack([points, goal])
    beyond = LABEL * size
    height = around[:, 2].max() + beyond if goal[2] > wrist[2] else around[:, 2].min() - beyond
    return np.array([*points[:, :2].mean(axis=0), height])


def around(state: State) -> Points:
    """Return what belongs in the picture beside the arm, (k, 3): the drawn positions and all of the label."""
    visits, size = visits_of(state), anatomy_of(state[Joints].arm).size
    points = drawn_points(visits, size)
    label = label_place(points, visits.goal, state[Joints].frames[-2, :3, 3], size)
    ends = label + BESIDE * size * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    return np.vstack([points.min(axis=0), points.max(axis=0), ends]).astype(np.float64)


def drawn_points(visits: Visits, size: float) -> Floats:
    """Return where the positions are drawn, (n, 3)."""
    return np.asarray(visits.goal + factor_of(visits, size) * (visits.points - visits.goal))


class Cloud:
    """The goal, the positions about it, and how much larger these are drawn."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        path, scene = canvas.path("taught_goal"), canvas.scene
        self._ball = scene.add_icosphere(
            f"{path}_goal", BALL * canvas.size, PURPLE, cast_shadow=False, receive_shadow=False
        )
        self._label: viser.LabelHandle = scene.add_label(
            f"{path}_label", "", font_screen_scale=0.9, anchor="center-center"
        )
        self._points: Any = None
        self._drawn: Visits | None = None

    def show(self, state: State) -> None:
        """Show the visits of a state."""
        visits = visits_of(state)
        if visits is self._drawn:
            return
        self._drawn = visits
        factor = factor_of(visits, self._canvas.size)
        move(self._ball, visits.goal)
        write(self._label, f"deviations × {factor:g}" if factor > 1.0 else "deviations in true size")
        drawn = drawn_points(visits, self._canvas.size)
        move(self._label, label_place(drawn, visits.goal, state[Joints].frames[-2, :3, 3], self._canvas.size))
        points = drawn.astype(np.float32)
        if self._points is None or len(self._points.points) != len(points):
            if self._points is not None:
                self._points.remove()
            self._points = self._canvas.scene.add_point_cloud(
                self._canvas.path("taught_goal_points"),
                points,
                ORANGE,
                point_size=DOT * self._canvas.size,
                point_shape="circle",
                precision="float32",
            )
        else:
            self._points.points = points


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the positions."""
    del state
    return Cloud(canvas).show


LAYER = Layer("taught_goal", order=73, watches=(TaughtGoal, Joints), build=build, panel="taught_goal")
