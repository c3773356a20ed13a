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
from armlab.kin.ik.method import methods
from armlab.kin.ik.rest import AT
from armlab.kin.ik.search import problem_of
from armlab.kin.ik.verdict import joint_values, task_error_of

Vector = NDArray[np.float64]

STEP = 0.15
"""Length of a step, in radians or length scales."""

LEAST_STEP = 1e-3
"""Smallest length of a step: the curve ends where a shorter one would be needed."""

MOST_STEPS = 2000
"""Largest number of steps in each direction: about 300 rad of travel."""

MOST_ON_SURFACE = 200
"""Largest number of steps where there is more than one direction to go: such a line need not close."""

EXACT = 1e-12
"""Scaled error of a point on the curve; Newton steps leave a much smaller one."""

FLOOR = 1e-13
"""Damping that keeps normal equations solvable at singular places; elsewhere it has no effect."""

AT_LIMIT, LIMIT_STEPS = 1e-11, 40
"""Distance, in radians or length scales, at which a joint is at its limit, and the number of attempts; six are
enough."""

RANK = 1e-7
"""Singular value of the scaled task Jacobian, relative to the largest, below which it counts as zero."""


@dataclass(frozen=True, eq=False)
class SelfMotion:
    """A curve of configurations with one tool pose.

    Attributes
    ----------
    q : ndarray, shape (m, n)
        Points in order, about `STEP` apart; a single one where nothing can move. Angles are continuous.
    target : ndarray, shape (4, 4)
        Pose of the tool, which stays constant.
    closed : bool
        Whether the last point is followed by the first, maybe whole turns on.
    freedom : int
        Dimension of the null space at the start: 1 for a curve, more for a surface of which this is one curve, 0 for
        an isolated solution.
    stops : tuple of int
        Places in q, from 0, of the joints whose limits stop it at its first and last point; -1 where it ends for
        another reason.
    bounds : ndarray, shape (2, n)
        Least and greatest joint values it was followed to.
    """

    q: Vector
    target: Vector
    closed: bool
    freedom: int
    stops: tuple[int, int]
    bounds: Vector

    def admits(self, q: Vector) -> bool:
        """Return whether joint values (n,) are inside the limits."""
        return bool(np.all((q >= self.bounds[0] - AT) & (q <= self.bounds[1] + AT)))


def self_motion(arm: Arm, q: ArrayLike, count: int, *, limits: bool = True) -> Vector:
    """Return configurations evenly along the self-motion through one, all with its tool pose.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
    count : int
        Number of points, at least 2.
    limits : bool
        Whether joint limits stop the motion; those a joint is outside of to begin with do not count.

    Returns
    -------
    ndarray, shape (count, n)
        Evenly in radians and length scales. A closed curve begins at q and goes once around; an open one goes from end
        to end. Where nothing can move, q alone, shape (1, n).

    Raises
    ------
    InputError
        Not n finite numbers, or a count below 2.
    """
    count = whole_number(count, "count", 2)
    values = joint_values(arm, q, "q")
    target = np.asarray(arm.fk(values), dtype=np.float64)
    return evenly(arm, trace_self_motion(arm, values, target, limits=limits), count)


def evenly(arm: Arm, motion: SelfMotion, count: int) -> Vector:
    """Return points evenly spaced along a traced curve, shape (count, n), or (1, n) when there is only one."""
    curve = motion.q
    if len(curve) == 1:
        return curve.copy()
    tracer = _Tracer(arm, curve[0], motion.target, limits=False)
    points = np.vstack([curve, _around(arm, curve)]) if motion.closed else curve
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0) / tracer.scales, axis=1))])
    wanted = np.linspace(0.0, along[-1], count, endpoint=not motion.closed)
    guesses = np.array([np.interp(wanted, along, points[:, i]) for i in range(arm.n)]).T
    found = []
    for s, guess in zip(wanted, guesses, strict=True):
        nearest = curve[min(int(np.argmin(np.abs(along - s))), len(curve) - 1)]
        back = tracer.corrected(guess)
        # Where a guess does not come back, or over a limit, the nearest point of the curve does as well.
        found.append(nearest if back is None or not motion.admits(back) else back)
    return np.array(found)


def trace_self_motion(arm: Arm, q: Vector, T: Vector, *, limits: bool = True, steps: int = MOST_STEPS) -> SelfMotion:
    """Return the self-motion through a solution q (n,) for a target T (4, 4) in the world, as far as it goes.

    The target and not the tool's own pose: of hands that are tilted differently two may have the angle phi of a third
    and not that of each other. For ``limits`` see `self_motion`; ``steps`` are taken at most in each direction.
    """
    tracer = _Tracer(arm, q, T, limits)
    start = tracer.null_space(q)
    freedom = start.shape[1]
    bounds = np.array([tracer.low, tracer.high])
    if freedom == 0:
        return SelfMotion(q[None], T, False, 0, (-1, -1), bounds)
    if freedom > 1:
        steps = min(steps, MOST_ON_SURFACE)
    direction = _canonical(start)
    ahead, closed, last = tracer.follow(q, direction, steps)
    if closed:
        return SelfMotion(np.array(ahead), T, True, freedom, (-1, -1), bounds)
    behind, _, first = tracer.follow(q, -direction, steps)
    return SelfMotion(np.array([*behind[:0:-1], *ahead]), T, False, freedom, (first, last), bounds)


class _Tracer:
    """Steps along the null space of one arm and one tool pose."""

    def __init__(self, arm: Arm, start: Vector, T: Vector, limits: bool) -> None:
        self.arm, self.start = arm, start
        self.scales = np.where(arm.revolute, 1.0, arm.length_scale)
        self.task = task_error_of(arm)
        self.target = self.task.target(T)
        # Without damping but for the floor: the shortest step back, at a singular configuration nearly so.
        self.step = problem_of(arm, methods()["dls"]).numbers(self.target, 0.0, None)
        self.floor = FLOOR * np.eye(arm.task.m)
        self.low, self.high = np.minimum(arm.limits[:, 0], start), np.maximum(arm.limits[:, 1], start)
        if not limits:
            # A slide would go on for ever.
            wide = np.where(arm.revolute, math.inf, arm.reach or 1.0)
            self.low, self.high = self.low - wide, self.high + wide

    def null_space(self, q: Vector, J: Vector | None = None) -> Vector:
        """Return an orthonormal basis (n, d) in scaled joint variables."""
        if J is None:
            J = self.task.at(q.tolist(), self.target)[0]
        _, sizes, vectors = np.linalg.svd(J)
        rank = int(np.sum(sizes > RANK * max(1.0, float(sizes.max(initial=0.0)))))
        return np.asarray(vectors[rank:].T)

    def corrected(self, q: Vector) -> Vector | None:
        """Return the solution (n,) of the task near q, or None."""
        found = self._corrected(q)
        return None if found is None else found[0]

    def _corrected(self, q: Vector) -> tuple[Vector, Vector] | None:
        """Return the solution (n,) of the task near q and the scaled task Jacobian (m, n) there, or None."""
        n, values = self.arm.n, q.tolist()
        for _ in range(8):
            numbers = self.step(values)
            if numbers[2 * n + 1] * self.task.per_square + numbers[2 * n + 2] <= EXACT**2:
                return np.array(values), self.task.at(values, self.target)[0]
            values = numbers[:n]
        return None

    def _solved(self, J: Vector, e: Vector) -> Vector:
        """Return (J J^T + floor)^-1 e."""
        return np.asarray(np.linalg.solve(J @ J.T + self.floor, e))

    def follow(self, q: Vector, direction: Vector, steps: int) -> tuple[list[Vector], bool, int]:
        """Return the points from q on, whether they close, and the joint (0-based) whose limit stops them, or -1."""
        points, length = [q], STEP
        heading = direction
        for number in range(steps):
            step = self._step(q, heading, length)
            if step is None:
                length /= 4.0
                if length < LEAST_STEP:
                    return points, False, -1
                continue
            there, J = step
            if float(self._over(there).max()) > AT_LIMIT:
                last, joint = self._up_to_limit(q, heading, length, there)
                return ([*points, last] if last is not None else points), False, joint
            moved = (there - q) / self.scales
            heading = self._onward(J, moved / np.linalg.norm(moved))
            q, length = there, min(STEP, 2.0 * length)
            if number > 2 and self._is_back(q, heading, direction):
                return points, True, -1
            points.append(q)
        return points, False, -1

    def _step(self, q: Vector, heading: Vector, length: float) -> tuple[Vector, Vector] | None:
        """Return the next point and the Jacobian there; None when the correction undoes much of the step."""
        found = self._corrected(q + length * heading * self.scales)
        if found is None:
            return None
        gone = (found[0] - q) / self.scales
        straight = float(gone @ heading)
        return found if straight > 0.5 * length and float(np.linalg.norm(gone)) < 1.5 * length else None

    def _onward(self, J: Vector, heading: Vector) -> Vector:
        """Return the heading projected on the null space; in several dimensions the path stays nearly straight."""
        ahead = heading - J.T @ self._solved(J, J @ heading)
        size = float(np.linalg.norm(ahead))
        return np.asarray(ahead / size) if size > 0.1 else heading

    def _over(self, q: Vector) -> Vector:
        """Return the distance of each joint beyond its limits, negative inside, in scaled variables."""
        return np.asarray(np.maximum(q - self.high, self.low - q) / self.scales)

    def _up_to_limit(self, q: Vector, heading: Vector, length: float, there: Vector) -> tuple[Vector | None, int]:
        """Return where a step that ends outside first meets a limit, and that joint; None where this is at q."""
        joint, point = -1, there
        for _ in range(self.arm.n):
            joint = int(np.argmax(self._over(point)))
            found = self._crossing(q, heading, length, point, joint)
            if found is None:
                return None, joint
            point, length = found
            if float(self._over(point).max()) <= AT_LIMIT:
                break
        return point, joint

    def _crossing(
        self, q: Vector, heading: Vector, length: float, there: Vector, joint: int
    ) -> tuple[Vector, float] | None:
        """Return the point where a joint is at its limit and its position on the step, by false position (Illinois)."""
        # Use the limit that was reached: a step across a narrow range begins at the other one.
        sign, limit = (1.0, self.high[joint]) if there[joint] > self.high[joint] else (-1.0, self.low[joint])
        out = sign / self.scales[joint]
        least, under = 0.0, float(out * (q[joint] - limit))
        most, over = length, float(out * (there[joint] - limit))
        before = 0
        for _ in range(LIMIT_STEPS):
            if under > -AT_LIMIT:
                return None
            middle = least + (most - least) * under / (under - over)
            point = self.corrected(q + middle * heading * self.scales)
            if point is None:
                return None
            beyond = float(out * (point[joint] - limit))
            if abs(beyond) <= AT_LIMIT:
                return point, middle
            side = 1 if beyond > 0.0 else -1
            if side > 0:
                most, over, under = middle, beyond, under / 2.0 if side == before else under
            else:
                least, under, over = middle, beyond, over / 2.0 if side == before else over
            before = side
        return None

    def _is_back(self, q: Vector, heading: Vector, direction: Vector) -> bool:
        """Return whether the curve is back at its start, up to whole turns."""
        if float(heading @ direction) <= 0.5:
            return False
        gap = _apart(self.arm, q - self.start) / self.scales
        return float(np.linalg.norm(gap)) < STEP and float(gap @ direction) >= -1e-9


def _apart(arm: Arm, gap: Vector) -> Vector:
    return np.where(arm.revolute, gap - math.tau * np.round(gap / math.tau), gap)


def _around(arm: Arm, curve: Vector) -> Vector:
    """Return the start of a closed curve again, with the whole turns of one round added."""
    gap = curve[0] - curve[-1]
    return np.asarray(curve[-1] + _apart(arm, gap))


def _canonical(basis: Vector) -> Vector:
    """Return one direction of a null space, always the same: towards the last joint that can move."""
    for joint in range(len(basis) - 1, -1, -1):
        ahead = basis @ basis[joint]
        size = float(np.linalg.norm(ahead))
        if size > 0.1:
            return np.asarray(ahead / size)
    return np.asarray(basis[:, 0])


def distance_to(arm: Arm, q: Vector, curves: Sequence[Vector]) -> float:
    """Return the distance of a configuration from the nearest point of curves, in radians and length scales."""
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    gaps = [float(np.linalg.norm(_apart(arm, curve - q) / scales, axis=1).min()) for curve in curves]
    return min(gaps, default=math.inf)
