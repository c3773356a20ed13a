"""The arm of the student's table as thick translucent sticks, as far as its rows are filled."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.trainer.state import Trainer
from armlab.kin.arm import Arm
from armlab.ui import adapter
from armlab.ui.colours import GREEN, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import lathe
from armlab.ui.scene._nodes import add_solid, move, seen
from armlab.ui.scene._sticks import corners_of, turns_to

THICK, BALL = 0.017, 0.026
"""Radii of sticks and of the balls at the origins, in sizes of the arm."""

OPACITY = 0.32
LEAST = 1e-6
"""Opacity of the sticks, and length of a stick, in sizes of the arm, below which it is not drawn."""


class Ghost:
    """The translucent arm, which is made with the first complete row."""

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
        """Show the arm of the student's table."""
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
        """Place the sticks for a configuration of the arm."""
        if not self._balls:
            return
        corners = np.empty((0, 3))
        if self._arm is not None:
            corners = corners_of(self._arm, (self._signs * q[: self._arm.n])[None])[0]
            corners = corners if self._whole else corners[:-1]
        ways = np.diff(corners, axis=0)
        lengths = np.linalg.norm(ways, axis=1)
        turns = turns_to(ways / np.maximum(lengths, 1e-12)[:, None])
        for k, stick in enumerate(self._sticks):
            drawn = k < len(lengths) and bool(lengths[k] > LEAST * self._canvas.size)
            seen(stick, drawn)
            if drawn:
                self._lay(k, corners[k], turns[k], float(lengths[k]))
        for k, ball in enumerate(self._balls):
            # Of the corners every second one is an origin.
            there = 2 * k < len(corners)
            seen(ball, there)
            if there:
                move(ball, corners[2 * k])

    def _lay(self, k: int, start: NDArray[np.float64], turn: NDArray[np.float64], length: float) -> None:
        w, x, y, z = turn.tolist()
        adapter.set_wxyz(self._sticks[k], (w, x, y, z))
        move(self._sticks[k], start)
        if abs(length - self._lengths[k]) > LEAST * self._canvas.size:
            self._lengths[k] = length
            width = THICK * self._canvas.size
            self._sticks[k].scale = (width, width, length)
