"""Sentences for students on why an iteration ended."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.iterate.loop import Fate, is_flat
from armlab.kin.ik.iterate.method import IterationMethod, Parameters
from armlab.kin.ik.iterate.problem import Floats, Point, Problem
from armlab.kin.ik.iterate.trace import Status
from armlab.kin.ik.rest import AT

NEARLY = 1e-6
"""Smallest singular value, relative to the largest, up to which a configuration is called singular."""

OTHERS = 8
"""Number of random configurations, with a fixed seed, that represent the generic one."""

FEW = 10
"""Smallest number of steps from which an iteration may be said to oscillate."""

NEAR = 0.1
"""Smallest singular value, relative to the largest, up to which a jump is put down to a singularity."""

NO_CLOSER = 0.99
"""Best cost of the second half of the steps, relative to that of the first, above which there is no progress."""

RISE = 1e-9
"""Relative rise of the cost in a step that is more than rounding."""


def jumps_of(problem: Problem, step: Floats) -> tuple[int, ...]:
    """Return the steps (from 1) in which a revolute joint turned by more than half a turn."""
    turned = np.abs(step[:, problem.arm.revolute]) > np.pi
    return tuple(int(k) + 1 for k in np.flatnonzero(turned.any(axis=1)))


def verdict(
    problem: Problem,
    method: IterationMethod,
    parameters: Parameters,
    fate: Fate,
    points: Point,
    cost: Floats,
    jumps: tuple[int, ...],
) -> tuple[Status, str]:
    """Return status and reason.

    Parameters
    ----------
    points : Point
        All iterates, B = k + 1.
    cost : ndarray, shape (k + 1,)
    """
    if fate == Fate.CONVERGED or problem.beyond:
        return plain_verdict(problem, fate == Fate.CONVERGED, points, cost, jumps)
    last, k = _last(points), len(cost) - 1
    if fate in (Fate.STUCK, Fate.SINGULAR):
        held = at_limits(problem, last.q[0]) if problem.clamp and not is_flat(last)[0] else ()
        if fate == Fate.STUCK and held:
            return "limit", f"stopped at the limits of {_joints(held)}"
        return _stuck(problem, method, fate, last)
    if fate == Fate.REPRESENTATION:
        text = "the Euler angles are singular here: the first and the third axis coincide"
        return "representation", f"{text}; choose another sequence, or the rotation vector as error"
    if fate == Fate.LIMIT:
        return "limit", f"stopped at the limits of {_joints(at_limits(problem, last.q[0]))}"
    # A run whose cost only falls has not diverged, whatever bound one of its iterates exceeds.
    failing = fate == Fate.DIVERGED or _rises(cost)
    warning = method.warn(problem, parameters, points.sigma_max[len(cost) // 2 :]) if method.warn and failing else ""
    if warning:
        return "diverged", f"diverged: {warning}"
    if fate == Fate.DIVERGED:
        return "diverged", f"diverged: {_grown(last, k)}{_after(jumps)}"
    return plain_verdict(problem, False, points, cost, jumps)


def plain_verdict(
    problem: Problem, converged: bool, points: Point, cost: Floats, jumps: tuple[int, ...]
) -> tuple[Status, str]:
    """Return status and reason of an iteration that converged or ran out of steps, the same for all methods."""
    if converged:
        return "converged", _converged(len(cost) - 1, jumps)
    if problem.beyond:
        return "out of reach", "out of reach: farther than the fully stretched arm"
    return _unfinished(problem, points, cost, jumps)


def _converged(k: int, jumps: tuple[int, ...]) -> str:
    return f"converged in {_steps(k)}{_after(jumps)}" if k else "at the target already: no step needed"


def _grown(last: Point, k: int) -> str:
    if k:
        return f"the error or the joint values grew without bound in {_steps(k)}"
    nearly = bool(last.sigma_min[0] <= NEARLY * last.sigma_max[0])
    return f"{'almost singular, ' if nearly else ''}even the first step would exceed all bounds"


def _stuck(problem: Problem, method: IterationMethod, fate: Fate, last: Point) -> tuple[Status, str]:
    if last.sigma_max[0] == 0.0:
        return "stuck", "stuck: no joint changes the task vector, J = 0"
    nearly = bool(last.sigma_min[0] <= NEARLY * last.sigma_max[0])
    everywhere = nearly and _has_usual_rank(problem, last)
    if not is_flat(last)[0]:
        if fate == Fate.SINGULAR and everywhere:
            return "singular", f"no step: J is singular in every configuration, and {method.title} has to invert it"
        if fate == Fate.SINGULAR:
            return "singular", f"no step: the configuration is singular, and {method.title} has to invert J"
        return "stuck", "stuck: no step of this method brings the tool closer"
    if everywhere:
        return "stuck", "closest point from here: Jᵀe = 0, and J has no more rank in other configurations"
    if nearly:
        return "stuck", "stuck at a singular configuration: Jᵀe = 0, although the error e is not 0"
    return "stuck", "closest point from here: Jᵀe = 0, with more task components than joints"


def _has_usual_rank(problem: Problem, last: Point) -> bool:
    """Return whether J has the rank here that it has elsewhere: what is lost is lost in every configuration."""
    q = np.repeat(last.q, OTHERS, axis=0)
    turns = np.where(problem.arm.revolute, 1.0, problem.arm.length_scale)
    drawn = np.random.default_rng(0).uniform(-3.0, 3.0, q.shape) * turns
    q[:, problem.free] = drawn[:, problem.free]
    here, there = (np.sum(sigma > NEARLY * sigma[:, :1], axis=1) for sigma in (last.sigma, problem.at(q).sigma))
    return bool(here[0] >= there.max())


def _unfinished(problem: Problem, points: Point, cost: Floats, jumps: tuple[int, ...]) -> tuple[Status, str]:
    k = len(cost) - 1
    if jumps:
        return "jumped", f"{_jumped(points, jumps[0])}; not reached in {_steps(k)}"
    held = at_limits(problem, points.q[-1]) if problem.clamp else ()
    if held:
        return "limit", f"not reached in {_steps(k)}, at the limits of {_joints(held)}"
    if k >= FEW and _rises(cost) and _no_closer(cost):
        return "most", f"not reached in {_steps(k)}: the iterates oscillate and come no closer"
    if k >= FEW and not _rises(cost) and cost[-1] > NO_CLOSER * cost[len(cost) // 2]:
        return "most", f"not reached in {_steps(k)}: the iterates come closer very slowly, if at all"
    return "most", f"not reached in {_steps(k)}, still converging: more steps may reach it"


def _jumped(points: Point, first: int) -> str:
    near = bool(points.sigma_min[first - 1] <= NEAR * points.sigma_max[first - 1])
    return (
        f"jumped: {'near a singularity ' if near else ''}a step turned a joint by more than half a turn, "
        f"first in step {first}"
    )


def _no_closer(cost: Floats) -> bool:
    half = len(cost) // 2
    return bool(cost[half:].min() > NO_CLOSER * cost[:half].min())


def _rises(cost: Floats) -> bool:
    """Return whether the cost rises in a step of the second half, by more than rounding."""
    late = cost[max(len(cost) // 2 - 1, 0) :]
    return bool(np.any(late[1:] > (1.0 + RISE) * late[:-1]))


def _last(points: Point) -> Point:
    return points.take(np.array([-1]))


def at_limits(problem: Problem, q: NDArray[np.float64]) -> tuple[int, ...]:
    """Return the free joints (1-based) at a limit."""
    low, high = problem.arm.limits.T
    at = (q <= low + AT) | (q >= high - AT)
    return tuple(int(i) + 1 for i in problem.free if at[i])


def scaling(problem: Problem) -> str:
    """Return in words how metres and radians are combined in one number for the error."""
    if problem.mixed:
        # As many figures for an arm of a millimetre as for one of a metre.
        length = f"{problem.length:.{max(3, 2 - math.floor(math.log10(problem.length)))}f}"
        return f"pure numbers: lengths are divided by {length} m, half the reach, where they meet radians"
    return "metres and radians as they are: only one kind occurs"


def _steps(k: int) -> str:
    return "1 step" if k == 1 else f"{k} steps"


def _after(jumps: tuple[int, ...]) -> str:
    return f", after a jump of more than half a turn in step {jumps[0]}" if jumps else ""


def _joints(numbers: tuple[int, ...]) -> str:
    if not numbers:
        return "the joints"
    return f"joint{'s' if len(numbers) > 1 else ''} {' and '.join(map(str, numbers))}"
