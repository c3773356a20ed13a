"""Newton's method on the distance itself, for targets that cannot be reached.

Gauss-Newton methods, damped least squares among them, linearise the error and forget its curvature. Where the error
stays large, at a stretched arm above all, the curvature is what decides, and they crawl. Here the second derivatives
are exact: with z_i the axis of joint i and J_j a column of the Jacobian,

    d2 p / dq_i dq_j = z_i x J_j                       for i <= j, joint i revolute, 0 for a prismatic joint i

and for the orientation, with rotation R = [r_1 r_2 r_3], target [t_1 t_2 t_3] and M = sum r_k t_k^T,

    d2 (sum r_k . t_k) / dq_i dq_j = z_i^T M z_j - (z_i . z_j) tr M

The squared distance is |position error|^2 / length scale^2 + 2 - 2 cos(theta), the same as everywhere; weights of the
components multiply its parts by their squares.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Number
from armlab.kin.graph.kernel import Kernel
from armlab.kin.graph.vector import Vector
from armlab.kin.ik.problem import FLOOR, Errors, Linearised, Posed, TaskError
from armlab.kin.ik.weights import Weights

NONE: Vector = (0.0, 0.0, 0.0)


class Closest(TaskError):
    """Newton steps towards the closest configuration of an arm, damped until they reduce the distance."""

    gain = 1e-3
    damped = True

    def linearise(
        self, q: Sequence[float], target: Sequence[float], gain: float, free: Sequence[float] | None
    ) -> Linearised:
        """Return one step from ``q`` and the errors there."""
        numbers = self._compiled(*q, *target, *([1.0] * self.arm.n if free is None else free), gain)
        return Linearised(numbers[: self._n], self.errors(numbers[self._n :]))

    def curve(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], Errors]:
        """Return the downhill slope (n) and the curvature (n, n) of half the squared scaled distance, and the errors.

        Both in scaled joint variables; zero for joints that are not free.
        """
        n = self.arm.n
        numbers, end = self._curved(*q, *target, *free), n + n * n
        return np.array(numbers[:n]), np.array(numbers[n:end]).reshape(n, n), self.errors(numbers[end:])

    @cached_property
    def _curved(self) -> Callable[..., tuple[float, ...]]:
        posed = Posed(self.arm, True, self.weights)
        H = [entry for row in _scaled_curvature(self.arm, posed) for entry in row]
        return Kernel(posed.graph, [*posed.slope, *H, *posed.squares], self._inputs()).scalar

    @cached_property
    def _compiled(self) -> Callable[..., tuple[float, ...]]:
        posed = Posed(self.arm, True, self.weights)
        mu = posed.cost * posed.graph.variable(self._inputs()) + FLOOR
        H = _scaled_curvature(self.arm, posed)
        for i in range(self.arm.n):
            H[i][i] = H[i][i] + mu
        step = vec.solve_symmetric(H, posed.slope)
        unscaled = [dq * scale for dq, scale in zip(step, posed.scales, strict=True)]
        return Kernel(posed.graph, [*unscaled, *posed.squares], self._inputs() + 1).scalar


def _scaled_curvature(arm: Arm, posed: Posed) -> list[list[Number]]:
    """Return `_curvature` in scaled joint variables, with zeros for joints that are not free."""
    curvature = _curvature(arm, posed)
    weights = [free * scale for free, scale in zip(posed.free, posed.scales, strict=True)]
    return [[weights[i] * weights[j] * curvature[i][j] for j in range(arm.n)] for i in range(arm.n)]


def _curvature(arm: Arm, posed: Posed) -> list[list[Number]]:
    """Return the second derivatives (n, n) of half the squared scaled distance, in joint variables."""
    n, coordinates = arm.n, arm.task.coordinates
    far = [posed.far[k] * pull for k, pull in zip(coordinates, posed.pulls, strict=True)]
    moves = [[column[k] for k in coordinates] for column in posed.linear]
    curvature: list[list[Number]] = [[0.0] * n for _ in range(n)]
    for i in range(n):
        turned = [vec.dot(posed.angular[i], column) for column in zip(*posed.overlap, strict=True)]
        for j in range(i, n):
            bend = vec.cross(posed.angular[i], posed.linear[j])
            pulled = [value * pull for value, pull in zip(moves[j], posed.pulls, strict=True)]
            placed = vec.dot(moves[i], pulled) - vec.dot(far, [bend[k] for k in coordinates])
            trace = posed.overlap[0][0] + posed.overlap[1][1] + posed.overlap[2][2]
            turning = vec.dot(posed.angular[i], posed.angular[j]) * trace - vec.dot(turned, posed.angular[j])
            curvature[i][j] = curvature[j][i] = placed + posed.turn_pull * turning
    return curvature


def closest_of(arm: Arm, weights: Weights | None = None) -> Closest:
    """Return the compiled solver of an arm (arms are compared by identity)."""
    return _closest_of(arm, weights)


@lru_cache(maxsize=64)
def _closest_of(arm: Arm, weights: Weights | None) -> Closest:
    return Closest(arm, weights)
