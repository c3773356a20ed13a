"""The shared loops of the compiled methods: a free descent for solving, and one inside limits for following a hand.

Both help a method along: they clip, shorten or repeat its steps, and stop as soon as nothing is left to gain. The loop
of `armlab.kin.ik.iterate` does none of this, because a lesson shows what a method does by itself.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.closest import Closest
from armlab.kin.ik.problem import Errors, Linearised, Problem
from armlab.kin.ik.rest import AT, way_down

TOLERANCE = 1e-8
"""Scaled error at which a descent stops: 10 nm on a 2 m arm, 0.6 millionths of a degree. A smaller one would lose
solutions near singularities, where the last digits converge slowly."""

CLOSE = 1e-8
"""Squared scaled error below which one step of a quadratically converging method is enough."""

STILL = 1e-9
"""Decrease of the error, relative to its square, below which a step is not taken: the arm then stays exactly where it
is when the same target comes again."""

SLIP = 0.1
"""Largest change of a joint, in scaled units, in the first step away from a balance: enough for the slope to take
over."""

MAX_STEP = 1.5
"""Largest change of a joint in one step, in scaled units (radians), for which the linearisation is meaningful."""


@dataclass(frozen=True)
class Descent:
    """The end of a descent.

    Attributes
    ----------
    q : list of float
        The best configuration.
    errors : Errors
        Errors with respect to the target.
    iterations : int
    """

    q: list[float]
    errors: Errors
    iterations: int

    @property
    def converged(self) -> bool:
        """Whether the descent has arrived; see `arrived`."""
        return arrived(self.errors)


def arrived(errors: Errors) -> bool:
    """Return whether the scaled error is within `TOLERANCE` and the target is reached: stricter for a very long arm."""
    return errors.scaled2 <= TOLERANCE**2 and errors.reached


def descend(
    problem: Problem,
    target: Sequence[float],
    q0: Sequence[float],
    free: Sequence[float] | None,
    limit: int,
    path: list[list[float]] | None = None,
) -> Descent:
    """Iterate without limits on the joints; the caller wraps the angles and looks at the limits.

    The plain method: each step is taken as it comes, only clipped to `MAX_STEP`. All iterates after ``q0`` are added to
    ``path`` where there is one.
    """
    # Behind every solution and every restart: numbers as they come, without an object for each step.
    q, n, per_square = list(q0), problem.arm.n, problem.per_square
    largest, step_at, squares = _largest_steps(problem), problem.numbers(target, problem.gain, free), 2 * n + 1
    for iteration in range(limit):
        numbers = step_at(q)
        square = numbers[squares] * per_square + numbers[squares + 1]
        if square <= TOLERANCE**2:
            errors = problem.errors(numbers[squares:])
            if arrived(errors):
                return Descent(q, errors, iteration)
        if numbers[2 * n] < MAX_STEP**2:
            q = list(numbers[:n])
        else:
            q = [value + _clip(dq, most) for value, dq, most in zip(q, numbers[n:], largest, strict=False)]
        if path is not None:
            path.append(q)
        if square < CLOSE:
            errors = problem.errors_at(q, target)
            if arrived(errors):
                return Descent(q, errors, iteration + 1)
    return Descent(q, problem.errors_at(q, target), limit)


def descend_inside(
    problem: Problem | Closest,
    target: Sequence[float],
    q0: Sequence[float],
    free: Sequence[float] | None,
    low: Sequence[float],
    high: Sequence[float],
    limit: int,
) -> Descent:
    """Iterate inside hard limits, and only ever downhill.

    A joint at a limit whose step points outwards is held for that step, and the step is made anew without it. A step
    that does not reduce the error is repeated shorter. So the arm comes to rest at the closest configuration downhill
    of ``q0`` and cannot jump, jitter or leave its limits, whatever the target is.
    """
    q = [min(max(value, lo), hi) for value, lo, hi in zip(q0, low, high, strict=True)]
    gain, shorten = problem.gain, 1.0
    largest = _largest_steps(problem)
    at = problem.linearise(q, target, gain, free)
    for iteration in range(limit):
        if arrived(at.errors):
            return Descent(q, at.errors, iteration)
        step = _inward_step(problem, q, at, target, gain, free, low, high)
        tried = [
            min(max(value + shorten * _clip(dq, most), lo), hi)
            for value, dq, most, lo, hi in zip(q, step, largest, low, high, strict=True)
        ]
        there = problem.linearise(tried, target, gain, free)
        if there.errors.cost < at.errors.cost:
            if _is_still(at.errors, there.errors):
                return Descent(q, at.errors, iteration + 1)
            q, at = tried, there
            gain, shorten = max(problem.gain, gain / 4.0), min(1.0, shorten * 2.0)
        elif problem.damped and gain < 1e6:
            gain *= 8.0
            at = problem.linearise(q, target, gain, free)
        else:
            shorten /= 4.0
            if shorten < 1e-6:
                return Descent(q, at.errors, iteration + 1)
    return Descent(q, at.errors, limit)


def _is_still(before: Errors, after: Errors) -> bool:
    # A cost that is nan is no gain either.
    return not before.cost - after.cost >= STILL * before.cost


def slip(
    closest: Closest,
    rest: Descent,
    target: Sequence[float],
    free: Sequence[float] | None,
    low: NDArray[np.float64],
    high: NDArray[np.float64],
) -> Descent | None:
    """Return a configuration beside one where a descent stopped, and closer; None where the arm truly rests.

    A descent stops on a balance, and seldom where its steps all lead out of the limits though the slope does not.
    """
    q = np.array(rest.q)
    way = None if rest.converged else way_down(closest, q, target, free, low, high)
    size = SLIP
    while way is not None and size > SLIP / 1000.0:
        tried = np.clip(q + size * way, low, high).tolist()
        errors = closest.linearise(tried, target, closest.gain, free).errors
        if not _is_still(rest.errors, errors):
            return Descent(tried, errors, rest.iterations + 1)
        size /= 4.0
    return None


def _inward_step(
    problem: Problem | Closest,
    q: Sequence[float],
    at: Linearised,
    target: Sequence[float],
    gain: float,
    free: Sequence[float] | None,
    low: Sequence[float],
    high: Sequence[float],
) -> Sequence[float]:
    step = at.step
    held = [1.0] * len(q) if free is None else list(free)
    for _ in q:
        outward = [
            i
            for i, dq in enumerate(step)
            if held[i] and ((q[i] <= low[i] and dq < 0.0) or (q[i] >= high[i] and dq > 0.0))
        ]
        if not outward:
            break
        for i in outward:
            held[i] = 0.0
        step = problem.linearise(q, target, gain, held).step
    return step


def _largest_steps(problem: Problem | Closest) -> list[float]:
    scale = problem.arm.length_scale
    return [MAX_STEP if row.revolute else MAX_STEP * scale for row in problem.arm.rows]


def _clip(value: float, most: float) -> float:
    # A step that is not a number (an overflow far outside every workspace) is no step.
    return min(max(value, -most), most) if math.isfinite(value) else 0.0


def wrapped(
    q: Sequence[float],
    near: NDArray[np.float64],
    revolute: NDArray[np.bool_],
    limits: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the same configuration with whole turns added to each angle, inside its limits and as near as possible.

    Parameters
    ----------
    q : sequence of n floats
    near : ndarray, shape (n,)
        Values to stay near to; all zero for angles in (-pi, pi].
    revolute, limits : ndarray, shapes (n,) and (n, 2)
        Joint types and limits. An angle that is outside its limits at every turn stays outside.
    """
    return np.array(
        [
            value + turns_inside(value, goal, low, high) if turns else value
            for value, goal, turns, (low, high) in zip(
                q, near.tolist(), revolute.tolist(), limits.tolist(), strict=True
            )
        ]
    )


def turns_inside(value: float, near: float, low: float, high: float) -> float:
    """Return the whole turns, in radians, that bring an angle inside its limits and nearest to another.

    Where no turn leads inside it is brought below the upper limit.
    """
    if low <= value <= high and abs(near - value) < math.pi:
        return 0.0
    turns = math.floor((near - value) / math.tau + 0.5)
    # The slack of `Arm.within_limits`: rounding at a limit must not cost a turn.
    least, most = math.ceil((low - AT - value) / math.tau), math.floor((high + AT - value) / math.tau)
    return math.tau * min(max(turns, least), most)
