"""Sentences for students on why an iteration ended."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.iterate.loop import Fate, is_flat
from armlab.kin.ik.iterate.method import IterationMethod, Parameters
from armlab.kin.ik.iterate.problem import Floats, Point, Problem
from armlab.kin.ik.iterate.trace import Status
from armlab.kin.ik.rest import AT

NEARLY = 1e-6
"""Smallest singular value, relative to the largest, up to which a configuration is called singular."""

FEW = 10
"""Smallest number of steps from which an iteration may be said to oscillate."""

NO_CLOSER = 0.99
"""Best cost of the second half of the steps, relative to that of the first, above which there is no progress."""


def jumps_of(problem: Problem, step: Floats) -> tuple[int, ...]:
    """Return the steps (from 1) in which a revolute joint turned by more than half a turn."""
    turned = np.abs(step[:, problem.arm.revolute]) > np.pi
    return tuple(int(k) + 1 for k in np.flatnonzero(turned.any(axis=1)))


def verdict(
    problem: Problem,
    method: IterationMethod,
    parameters: Parameters,
    fate: Fate,
    last: Point,
    sigma_max: Floats,
    cost: Floats,
    jumps: tuple[int, ...],
) -> tuple[Status, str]:
    """Return status and reason.

    Parameters
    ----------
    last : Point
        The last iterate, B = 1.
    sigma_max, cost : ndarray, shape (k + 1,)
    """
    k = len(sigma_max) - 1
    if fate == Fate.CONVERGED or problem.beyond:
        return plain_verdict(problem, fate == Fate.CONVERGED, last, cost, jumps)
    if fate in (Fate.STUCK, Fate.SINGULAR):
        held = at_limits(problem, last.q[0]) if problem.clamp and not is_flat(last)[0] else ()
        if fate == Fate.STUCK and held:
            return "limit", f"stopped at the limits of {_joints(held)}"
        return _stuck(method, fate, last)
    if fate == Fate.REPRESENTATION:
        text = "the Euler angles are singular here: the first and the third axis coincide"
        return "representation", f"{text}; choose another sequence, or the rotation vector as error"
    if fate == Fate.LIMIT:
        return "limit", f"stopped at the limits of {_joints(at_limits(problem, last.q[0]))}"
    warning = method.warn(problem, parameters, sigma_max[len(sigma_max) // 2 :]) if method.warn else ""
    if warning:
        return "diverged", f"diverged: {warning}"
    if fate == Fate.DIVERGED:
        return "diverged", f"diverged: {_grown(last, k)}{_after(jumps)}"
    return plain_verdict(problem, False, last, cost, jumps)


def plain_verdict(
    problem: Problem, converged: bool, last: Point, cost: Floats, jumps: tuple[int, ...]
) -> tuple[Status, str]:
    """Return status and reason of an iteration that converged or ran out of steps, the same for all methods."""
    if converged:
        return "converged", _converged(len(cost) - 1, jumps)
    if problem.beyond:
        return "out of reach", "out of reach: farther than the fully stretched arm"
    return _unfinished(problem, last, cost, jumps)


def _converged(k: int, jumps: tuple[int, ...]) -> str:
    return f"converged in {_steps(k)}{_after(jumps)}" if k else "at the target already: no step needed"


def _grown(last: Point, k: int) -> str:
    if k:
        return f"the error or the joint values grew without bound in {_steps(k)}"
    nearly = bool(last.sigma_min[0] <= NEARLY * last.sigma_max[0])
    return f"{'almost singular, ' if nearly else ''}even the first step would exceed all bounds"


def _stuck(method: IterationMethod, fate: Fate, last: Point) -> tuple[Status, str]:
    nearly = bool(last.sigma_min[0] <= NEARLY * last.sigma_max[0])
    if last.sigma_max[0] == 0.0:
        return "stuck", "stuck: no joint changes the task vector, J = 0"
    if not is_flat(last)[0]:
        if fate == Fate.SINGULAR:
            return "singular", f"no step: the configuration is singular, and {method.title} has to invert J"
        return "stuck", "stuck: no step of this method brings the tool closer"
    if nearly:
        return "stuck", "stuck at a singular configuration: Jᵀe = 0, although the error e is not 0"
    return "stuck", "closest point from here: Jᵀe = 0, with more task components than joints"


def _unfinished(problem: Problem, last: Point, cost: Floats, jumps: tuple[int, ...]) -> tuple[Status, str]:
    k = len(cost) - 1
    if jumps:
        text = "jumped: near a singularity a step turned a joint by more than half a turn"
        return "jumped", f"{text}, first in step {jumps[0]}; not reached in {_steps(k)}"
    held = at_limits(problem, last.q[0]) if problem.clamp else ()
    if held:
        return "limit", f"not reached in {_steps(k)}, at the limits of {_joints(held)}"
    half = len(cost) // 2
    if k >= FEW and cost[half:].min() > NO_CLOSER * cost[:half].min():
        return "most", f"not reached in {_steps(k)}: the iterates oscillate and come no closer"
    return "most", f"not reached in {_steps(k)}, still converging: more steps may reach it"


def at_limits(problem: Problem, q: NDArray[np.float64]) -> tuple[int, ...]:
    """Return the free joints (1-based) at a limit."""
    low, high = problem.arm.limits.T
    at = (q <= low + AT) | (q >= high - AT)
    return tuple(int(i) + 1 for i in problem.free if at[i])


def scaling(problem: Problem) -> str:
    """Return in words how metres and radians are combined in one number for the error."""
    if problem.mixed:
        return f"pure numbers: lengths are divided by {problem.length:.3f} m, half the reach, where they meet radians"
    return "metres and radians as they are: only one kind occurs"


def _steps(k: int) -> str:
    return "1 step" if k == 1 else f"{k} steps"


def _after(jumps: tuple[int, ...]) -> str:
    return f", after a jump of more than half a turn in step {jumps[0]}" if jumps else ""


def _joints(numbers: tuple[int, ...]) -> str:
    if not numbers:
        return "the joints"
    return f"joint{'s' if len(numbers) > 1 else ''} {' and '.join(map(str, numbers))}"
