"""The motion of a redundant arm while its tool stands still.

A curve in joint space: from a solution a short step along the null space of the task Jacobian, then Newton steps back
to the task, and on until the curve closes on itself, a limit stops it, or it ends in a point.

References
----------
Burdick 1989, *On the inverse kinematics of redundant manipulators*; notes, sections 4.3.1 and 5.1 (m < n).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.ik.verdict import joint_values, task_error_of

Vector = NDArray[np.float64]

STEP = 0.1
"""Length of a step, radians or length scales."""

LEAST_STEP = 1e-3
"""A step that has to be shorter than this ends the curve."""

MOST_STEPS = 2000
"""In each direction: about 200 rad of travel."""

EXACT = 1e-11
"""Scaled error of a point on the curve; Newton steps leave a much smaller one."""

RANK = 1e-7
"""Singular values of the scaled task Jacobian below this, relative to the largest, are zero."""


@dataclass(frozen=True, eq=False)
class SelfMotion:
    """A curve of configurations with one tool pose.

    Attributes
    ----------
    q : ndarray, shape (m, n)
        Points in order, about `STEP` apart; a single one where nothing can move. Angles are continuous.
    closed : bool
        Whether the last point is followed by the first, maybe whole turns on.
    freedom : int
        Dimension of the null space at the start: 1 for a curve, more for a surface of which this is one curve, 0 for
        an isolated solution.
    stops : tuple of int
        0-based joints whose limits stop it at its first and last point; -1 where it ends for another reason.
    """

    q: Vector
    closed: bool
    freedom: int
    stops: tuple[int, int]


def self_motion(arm: Arm, q: ArrayLike, count: int, *, limits: bool = True) -> Vector:
    """Return configurations evenly along the self-motion through one, all with its tool pose.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
    count : int
        At least 2.
    limits : bool
        Whether joint limits stop the motion; those a joint is outside of to begin with do not count.

    Returns
    -------
    ndarray, shape (count, n)
        Evenly in radians and length scales. Of a closed curve it begins with q and goes once around; of an open one it
        goes from end to end. Where nothing can move, q alone, shape (1, n).

    Raises
    ------
    InputError
        Not n finite numbers, or a count below 2.
    """
    count = whole_number(count, "count", 2)
    values = joint_values(arm, q, "q")
    return evenly(arm, trace_self_motion(arm, values, limits=limits), count)


def evenly(arm: Arm, motion: SelfMotion, count: int) -> Vector:
    """Return points evenly along a traced curve, shape (count, n), or (1, n) where there is only one."""
    curve = motion.q
    if len(curve) == 1:
        return curve.copy()
    tracer = _Tracer(arm, curve[0], limits=False)
    points = np.vstack([curve, _around(arm, curve)]) if motion.closed else curve
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0) / tracer.scales, axis=1))])
    wanted = np.linspace(0.0, along[-1], count, endpoint=not motion.closed)
    guesses = np.array([np.interp(wanted, along, points[:, i]) for i in range(arm.n)]).T
    back = (tracer.corrected(guess) for guess in guesses)
    # Where a guess does not come back the nearest point of the curve does as well.
    nearest = (curve[min(int(np.argmin(np.abs(along - s))), len(curve) - 1)] for s in wanted)
    return np.array([one if one is not None else other for one, other in zip(back, nearest, strict=True)])


def trace_self_motion(arm: Arm, q: ArrayLike, *, limits: bool = True) -> SelfMotion:
    """Return the self-motion through a configuration, as far as it goes; see `self_motion`."""
    values = joint_values(arm, q, "q")
    tracer = _Tracer(arm, values, limits)
    start = tracer.null_space(values)
    freedom = start.shape[1]
    if freedom == 0:
        return SelfMotion(values[None], False, 0, (-1, -1))
    direction = _canonical(start)
    ahead, closed, last = tracer.follow(values, direction)
    if closed:
        return SelfMotion(np.array(ahead), True, freedom, (-1, -1))
    behind, _, first = tracer.follow(values, -direction)
    return SelfMotion(np.array([*behind[:0:-1], *ahead]), False, freedom, (first, last))


class _Tracer:
    """Steps along the null space of one arm and one tool pose."""

    def __init__(self, arm: Arm, start: Vector, limits: bool) -> None:
        self.arm, self.start = arm, start
        self.scales = np.where(arm.revolute, 1.0, arm.length_scale)
        self.task = task_error_of(arm)
        self.target = self.task.target(np.asarray(arm.fk(start), dtype=np.float64))
        wide = 0.0 if limits else math.inf
        self.low = np.minimum(arm.limits[:, 0], start) - wide
        self.high = np.maximum(arm.limits[:, 1], start) + wide

    def null_space(self, q: Vector, J: Vector | None = None) -> Vector:
        """Return an orthonormal basis (n, d) in scaled joint variables."""
        if J is None:
            J = self.task.at(q.tolist(), self.target)[0]
        _, sizes, vectors = np.linalg.svd(J)
        rank = int(np.sum(sizes > RANK * max(1.0, float(sizes.max(initial=0.0)))))
        return np.asarray(vectors[rank:].T)

    def corrected(self, q: Vector) -> Vector | None:
        """Return the point of the task's solutions near q, or None."""
        found = self._corrected(q)
        return None if found is None else found[0]

    def _corrected(self, q: Vector) -> tuple[Vector, Vector] | None:
        """Return the same, and the scaled task Jacobian there."""
        for _ in range(8):
            J, e, _ = self.task.at(q.tolist(), self.target)
            if float(e @ e) <= EXACT**2:
                return q, J
            q = q + np.linalg.lstsq(J, e, rcond=RANK)[0] * self.scales
        return None

    def follow(self, q: Vector, direction: Vector) -> tuple[list[Vector], bool, int]:
        """Return the points from q on, whether they close, and the joint (0-based) whose limit stops them or -1."""
        points, length = [q], STEP
        heading = direction
        for number in range(MOST_STEPS):
            step = self._step(q, heading, length)
            if step is None:
                length /= 4.0
                if length < LEAST_STEP:
                    return points, False, -1
                continue
            there, J = step
            out = np.flatnonzero((there < self.low) | (there > self.high))
            if len(out):
                last, joint = self._up_to_limit(q, heading, length, int(out[0]))
                return ([*points, last] if last is not None else points), False, joint
            moved = (there - q) / self.scales
            heading = self._onward(there, J, moved / np.linalg.norm(moved))
            q, length = there, min(STEP, 2.0 * length)
            if number > 2 and self._is_back(q, heading, direction):
                return points, True, -1
            points.append(q)
        return points, False, -1

    def _step(self, q: Vector, heading: Vector, length: float) -> tuple[Vector, Vector] | None:
        """Return the point a step on and the Jacobian there; None where the correction takes much of it back."""
        found = self._corrected(q + length * heading * self.scales)
        if found is None:
            return None
        gone = (found[0] - q) / self.scales
        straight = float(gone @ heading)
        return found if straight > 0.5 * length and float(np.linalg.norm(gone)) < 1.5 * length else None

    def _onward(self, q: Vector, J: Vector, heading: Vector) -> Vector:
        """Return the heading projected on the null space; in more than one dimension it goes as straight as it can."""
        basis = self.null_space(q, J)
        ahead = basis @ (basis.T @ heading)
        size = float(np.linalg.norm(ahead))
        return np.asarray(ahead / size) if size > 0.1 else heading

    def _up_to_limit(self, q: Vector, heading: Vector, length: float, joint: int) -> tuple[Vector | None, int]:
        """Return the last point inside the limits on this step, by bisection, and the joint at its limit."""
        inside, least, most = None, 0.0, length
        for _ in range(40):
            middle = 0.5 * (least + most)
            there = self.corrected(q + middle * heading * self.scales)
            if there is None:
                most = middle
                continue
            out = np.flatnonzero((there < self.low) | (there > self.high))
            if len(out):
                most, joint = middle, int(out[0])
            else:
                inside, least = there, middle
        return inside, joint

    def _is_back(self, q: Vector, heading: Vector, direction: Vector) -> bool:
        """Return whether the curve has come to where it started, whole turns apart counting as the same."""
        gap = _apart(self.arm, q - self.start) / self.scales
        return (
            float(np.linalg.norm(gap)) < STEP and float(gap @ direction) >= -1e-9 and float(heading @ direction) > 0.5
        )


def _apart(arm: Arm, gap: Vector) -> Vector:
    return np.where(arm.revolute, gap - math.tau * np.round(gap / math.tau), gap)


def _around(arm: Arm, curve: Vector) -> Vector:
    """Return the start of a closed curve again, with the turns that going around it has made."""
    gap = curve[0] - curve[-1]
    return np.asarray(curve[-1] + _apart(arm, gap))


def _canonical(basis: Vector) -> Vector:
    """Return one direction of a null space, the same for the same space: towards the last joint that can move."""
    for joint in range(len(basis) - 1, -1, -1):
        ahead = basis @ basis[joint]
        size = float(np.linalg.norm(ahead))
        if size > 0.1:
            return np.asarray(ahead / size)
    return np.asarray(basis[:, 0])


def distance_to(arm: Arm, q: Vector, curves: Sequence[Vector]) -> float:
    """Return how far a configuration is from the nearest point of some curves, in radians and length scales."""
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    gaps = [float(np.linalg.norm(_apart(arm, curve - q) / scales, axis=1).min()) for curve in curves]
    return min(gaps, default=math.inf)
