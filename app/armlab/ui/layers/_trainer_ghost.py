"""The arm of the person's table as thick translucent sticks, as far as its rows are filled."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.session.parts.trainer import Trainer
from armlab.ui import adapter
from armlab.ui.colours import GREEN, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import lathe
from armlab.ui.layers._nodes import add_solid, move, seen

THICK, BALL = 0.017, 0.026
"""Radii of sticks and of the balls at the origins, in sizes of the arm."""

OPACITY = 0.32
LEAST = 1e-6
"""Length of a stick, in sizes of the arm, below which it is not drawn."""

OPPOSITE = 1e-12
"""How near to minus z, in its cosine, a stick is turned about x instead."""

Points = list[NDArray[np.float64]]


class Ghost:
    """The translucent arm; made with the first complete row."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._sticks: list[Any] = []
        self._lengths: list[float] = []
        self._balls: list[Any] = []
        self._arm: Arm | None = None
        self._signs = np.ones(0)
        self._whole = False
        self._done = False
        canvas.on_pose(self._place)

    def show(self, trainer: Trainer) -> None:
        """Show the arm of a person's table."""
        arm = trainer.student_arm
        if arm is self._arm:
            return
        self._arm = arm
        if arm is not None and trainer.assignment is not None:
            self._make(trainer.exercise.n)
            self._signs = trainer.assignment.signs[: arm.n]
            self._whole = arm.n == trainer.exercise.n
            self._colour(trainer.done)
        self._place(self._canvas.shown_pose)

    def _make(self, n: int) -> None:
        if self._balls:
            return
        scene, path, size = self._canvas.scene, self._canvas.path("trainer_arm"), self._canvas.size
        scene.add_frame(path, show_axes=False)
        rod = lathe([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], sides=20)
        look: dict[str, Any] = {"color": VERMILLION, "opacity": OPACITY, "cast_shadow": False, "receive_shadow": False}
        for k in range(2 * n + 1):
            self._sticks.append(add_solid(scene, f"{path}/stick{k}", rod, VERMILLION, opacity=OPACITY))
            self._lengths.append(-1.0)
        self._balls = [scene.add_icosphere(f"{path}/ball{k}", BALL * size, **look) for k in range(n + 1)]

    def _colour(self, done: bool) -> None:
        if done != self._done:
            self._done = done
            for handle in (*self._sticks, *self._balls):
                handle.color = GREEN if done else VERMILLION

    def _place(self, q: NDArray[np.float64]) -> None:
        """Put the sticks where the configuration of the arm puts them."""
        if not self._balls:
            return
        points: Points = []
        tool: NDArray[np.float64] | None = None
        if self._arm is not None:
            values = self._signs * q[: self._arm.n]
            frames = np.asarray(self._arm.frames(values), dtype=np.float64)
            points = _corners(frames)
            tool = (frames[-1] @ self._arm.tool)[:3, 3] if self._whole else None
        ends = [*points, tool] if tool is not None else points
        for k, stick in enumerate(self._sticks):
            self._lay(k, stick, ends[k : k + 2])
        for k, ball in enumerate(self._balls):
            seen(ball, 2 * k < len(points))
            if 2 * k < len(points):
                move(ball, points[2 * k])

    def _lay(self, k: int, stick: Any, ends: Points) -> None:
        length = float(np.linalg.norm(ends[1] - ends[0])) if len(ends) == 2 else 0.0
        drawn = length > LEAST * self._canvas.size
        seen(stick, drawn)
        if not drawn:
            return
        adapter.set_wxyz(stick, _turn_to((ends[1] - ends[0]) / length))
        move(stick, ends[0])
        if abs(length - self._lengths[k]) > LEAST * self._canvas.size:
            self._lengths[k] = length
            width = THICK * self._canvas.size
            stick.scale = (width, width, length)


def _corners(frames: NDArray[np.float64]) -> Points:
    """Return the way of the table along d and a: origin, corner, origin, ..."""
    points: Points = [frames[0, :3, 3]]
    for before, after in pairwise(frames):
        z, place = before[:3, 2], before[:3, 3]
        points += [place + ((after[:3, 3] - place) @ z) * z, after[:3, 3]]
    return points


def _turn_to(direction: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Return the shortest turn, as wxyz, that takes z to a unit vector."""
    x, y, z = direction.tolist()
    if z < -1.0 + OPPOSITE:
        return 0.0, 1.0, 0.0, 0.0
    w = math.sqrt(0.5 * (1.0 + z))
    return w, -0.5 * y / w, 0.5 * x / w, 0.0
