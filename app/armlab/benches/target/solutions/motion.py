"""The self-motion for a slider: through the present configuration, inside the limits, with held joints held."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.question import Question
from armlab.kin.arm import Arm
from armlab.kin.ik.held import with_held
from armlab.kin.ik.self_motion import trace_self_motion
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import solution
from armlab.session.way_to_solution import ON_CURVE

Vector = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Motion:
    """A curve of solutions.

    Attributes
    ----------
    q : ndarray, shape (m, n)
        Points in order.
    along : ndarray, shape (m,)
        How far along the curve they are, 0 to 1.
    closed : bool
        Whether it goes on from its end to its beginning.
    stops : tuple of int
        0-based joints whose limits end it; -1 where it ends for another reason or is closed.
    """

    q: Vector
    along: Vector
    closed: bool
    stops: tuple[int, int]

    def is_on(self, arm: Arm, q: NDArray[np.float64]) -> bool:
        """Return whether a configuration is on the curve; one that is whole turns beside it is not."""
        # Along the curve an arm comes from one to the other at best by a way round, and maybe not inside the limits.
        scales = np.where(arm.revolute, 1.0, arm.length_scale)
        return float(np.linalg.norm((self.q - q) / scales, axis=1).min()) < ON_CURVE

    def part(self, arm: Arm, q: NDArray[np.float64]) -> float:
        """Return the place of a configuration along the curve, 0 to 1."""
        scales = np.where(arm.revolute, 1.0, arm.length_scale)
        k = int(np.argmin(np.abs((self.q - q) / scales).max(axis=1)))
        best, nearest = float(self.along[k]), np.inf
        for i in (k - 1, k):
            if not 0 <= i < len(self.q) - 1:
                continue
            edge, way = (self.q[i + 1] - self.q[i]) / scales, (q - self.q[i]) / scales
            s = min(max(float(way @ edge) / max(float(edge @ edge), 1e-300), 0.0), 1.0)
            far = float(np.linalg.norm(way - s * edge))
            if far < nearest:
                best, nearest = float(self.along[i] + s * (self.along[i + 1] - self.along[i])), far
        return best

    def at(self, question: Question, part: float) -> Vector | None:
        """Return the solution at a part of the curve, or None if it cannot be refined to an exact one."""
        arm = question.arm
        guess = np.array([np.interp(part, self.along, column) for column in self.q.T])
        held = np.array([i + 1 in question.held for i in range(arm.n)])
        exact = solution(arm, guess, task_error_of(arm).target(question.pose), held if held.any() else None)
        if exact is not None and arm.within_limits(exact):
            return np.asarray(exact)
        # At its ends, and where it touches a limit, the points that were traced are inside.
        inside = [k for k in range(len(self.q)) if arm.within_limits(self.q[k])]
        return self.q[min(inside, key=lambda k: abs(float(self.along[k]) - part))] if inside else None


def motion_through(question: Question, q: NDArray[np.float64]) -> Motion | None:
    """Return the self-motion through a configuration (n,) that solves the question, or None if nothing can move."""
    arm, free = question.arm, question.free()
    if not question.held:
        rest: Arm | None = arm
    else:
        rest = with_held(arm, {joint - 1: value for joint, value in question.held.items()})
    if rest is None or not free:
        return None
    pose = np.asarray(question.pose, dtype=np.float64)
    traced = trace_self_motion(rest, np.asarray(q, dtype=np.float64)[free], pose)
    if len(traced.q) < 3:
        return None
    points = np.tile(np.asarray(q, dtype=np.float64), (len(traced.q), 1))
    points[:, free] = traced.q
    if traced.closed:
        points = np.vstack([points, _around(arm, points)])
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0) / scales, axis=1))])
    first, last = (free[joint] if joint >= 0 else -1 for joint in traced.stops)
    return Motion(points, way / way[-1], traced.closed, (first, last))


def _around(arm: Arm, points: Vector) -> Vector:
    """Return the beginning of a closed curve as the continuation of its end, with the turns made on the way."""
    step = points[0] - points[-1]
    turned = step - 2.0 * np.pi * np.round(step / (2.0 * np.pi))
    return np.asarray(points[-1] + np.where(arm.revolute, turned, step))
