"""One solution of the inverse kinematics: descents from the given and from random starts, inside the limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.ik.closest import closest_of
from armlab.kin.ik.loop import Descent, descend, descend_inside, slip, wrapped
from armlab.kin.ik.method import Method, method_named
from armlab.kin.ik.problem import Errors, Problem
from armlab.kin.ik.verdict import Verdict, checked_locks, free_joints, joint_values, judge
from armlab.kin.transforms import as_pose

ITERATIONS = 22
"""Steps of one descent; a start that has not converged by then is replaced by another: cheaper than waiting."""

SEARCHES = 100
"""Starts before giving up."""

STEPS_INSIDE = 20
"""Steps of the method inside limits; what is not reached by then probably cannot be."""

STEPS_CLOSEST = 100
"""Steps of Newton's method towards the closest configuration after that; it needs five to ten."""

BALANCES = 4
"""Descents of that kind at most, each after slipping off a balance; what is left then waits for the next call."""


@dataclass(frozen=True)
class IkResult:
    """The outcome of a solve; a target that cannot be reached is an outcome, too.

    Attributes
    ----------
    success : bool
        Reached inside the limits, within 1e-6 m and 1e-6 rad.
    q : ndarray, shape (n,)
        The solution, or the closest configuration found.
    position_error, rotation_error : float
        Metres and radians, of the components the task controls.
    iterations : int
        Steps in all.
    reason : str
        What a student should know, in words.
    verdict : Verdict
        The same as data.
    """

    success: bool
    q: NDArray[np.float64]
    position_error: float
    rotation_error: float
    iterations: int
    reason: str
    verdict: Verdict


FAR = Errors(math.inf, math.inf, 1.0)
"""The errors of a search that found nothing."""


@lru_cache(maxsize=64)
def problem_of(arm: Arm, method: Method) -> Problem:
    """Return the compiled problem of an arm (arms are compared by identity)."""
    return Problem(arm, method)


def solve(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike | None = None,
    method: str = "dls",
    seed: int = 0,
    locked: Sequence[bool] | None = None,
    searches: int = SEARCHES,
) -> IkResult:
    """Find joint values that put the tool at a pose, as far as the arm's task goes.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world. Components outside the task are ignored.
    q0 : array_like, shape (n,), optional
        First start; random when left out. Angles of the solution are those nearest to it, whole turns apart, inside the
        limits; in (-pi, pi], where the limits allow, when left out.
    method : str
        Key of a method: see `methods`.
    seed : int
        Of the random starts; the same call gives the same answer.
    locked : sequence of bool, optional
        Joints that keep their value in ``q0``.
    searches : int
        Number of starts, at least 1.

    Raises
    ------
    InputError
        ``T`` is no pose, shapes or numbers are wrong, or joints are locked without a ``q0``.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> result = solve(arm, arm.fk([0.4, 0.9]), q0=[0.0, 0.5])
    >>> result.success, result.q.round(6).tolist()
    (True, [0.4, 0.9])
    """
    pose = as_pose(T, "T")
    start = None if q0 is None else joint_values(arm, q0, "q0")
    free = free_joints(checked_locks(arm, locked))
    if free is not None and start is None:
        raise InputError("locked: give q0, the values the locked joints keep")
    seed, searches = whole_number(seed, "seed", 0), whole_number(searches, "searches", 1)
    problem = problem_of(arm, method_named(method))
    target = problem.target(pose)
    found = _search(problem, target, start, free, seed, searches)
    verdict = Verdict("reached", found.errors.position, found.errors.rotation, ())
    if not found.converged:
        from_here = arm.clip(np.zeros(arm.n)) if start is None else start
        rest = come_closer(problem, target, from_here, free)
        found = Descent(rest.q, rest.errors, found.iterations + rest.iterations)
        verdict = judge(arm, pose, found.q, locked)
    return IkResult(
        success=verdict.reached,
        q=np.array(found.q),
        position_error=verdict.position_error,
        rotation_error=verdict.rotation_error,
        iterations=found.iterations,
        reason=verdict.reason,
        verdict=verdict,
    )


def _search(
    problem: Problem,
    target: Sequence[float],
    start: NDArray[np.float64] | None,
    free: Sequence[float] | None,
    seed: int,
    searches: int,
) -> Descent:
    """Try one start after the other until one converges inside the limits; return it, or the last."""
    arm, iterations = problem.arm, 0
    rng = np.random.default_rng(seed)
    low, width = problem.starts
    held = None if free is None else np.array(free) == 0.0
    near = np.zeros(arm.n) if start is None else start
    q = low
    for search in range(searches):
        q = start if search == 0 and start is not None else low + width * rng.random(arm.n)
        if held is not None and start is not None:
            q = np.where(held, start, q)
        descent = descend(problem, target, q.tolist(), free, ITERATIONS)
        iterations += descent.iterations
        if descent.converged:
            solution = wrapped(descent.q, near, arm.revolute, arm.limits)
            solution = solution if held is None else np.where(held, q, solution)
            if arm.within_limits(solution):
                return Descent(solution.tolist(), descent.errors, iterations)
    return Descent(q.tolist(), FAR, iterations)


def come_closer(
    problem: Problem,
    target: Sequence[float],
    q0: ArrayLike,
    free: Sequence[float] | None,
    travel: float = math.inf,
) -> Descent:
    """Go downhill inside the limits from ``q0``, each joint by at most ``travel`` (rad, or length scales)."""
    arm = problem.arm
    start = arm.clip(q0)
    box = np.where(arm.revolute, travel, travel * arm.length_scale)
    low = np.maximum(arm.limits[:, 0], start - box)
    high = np.minimum(arm.limits[:, 1], start + box)
    inside = low.tolist(), high.tolist()
    found = descend_inside(problem, target, start.tolist(), free, *inside, STEPS_INSIDE)
    if found.converged:
        return found
    closest = closest_of(arm)
    for _ in range(BALANCES):
        rest = descend_inside(closest, target, found.q, free, *inside, STEPS_CLOSEST)
        found = Descent(rest.q, rest.errors, found.iterations + rest.iterations)
        beside = slip(closest, found, target, free, low, high)
        if beside is None:
            break
        found = beside
    return found
