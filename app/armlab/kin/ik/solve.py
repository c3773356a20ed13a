"""One solution of the inverse kinematics: descents from a given start, samples near the target, and random starts.

Where all fail, the list of all solutions has the last word for arms that have one: a solution, or the proof that there
is none. The result is then the closest configuration downhill of the start, or of samples near the target without one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.ik.closest import closest_of
from armlab.kin.ik.iterate.method import iteration_methods
from armlab.kin.ik.iterate.trace import Trace
from armlab.kin.ik.known import Known, known_solution
from armlab.kin.ik.loop import Descent, descend_inside, slip
from armlab.kin.ik.method import methods
from armlab.kin.ik.problem import REACHED_M, Problem
from armlab.kin.ik.search import Begin, Searched, compiled_search, iterated_search, problem_of
from armlab.kin.ik.turned_over import TURNED_OVER, is_turned_over
from armlab.kin.ik.verdict import Verdict, checked_locks, joint_values, judge, task_error_of
from armlab.kin.ik.weights import Weights, checked_weights
from armlab.kin.transforms import as_pose

SEARCHES = 100
"""Largest number of starts."""

STEPS_INSIDE = 20
"""Steps of the method inside limits; a target not reached by then probably cannot be reached."""

STEPS_CLOSEST = 100
"""Largest number of Newton steps towards the closest configuration after that; five to ten are usual."""

BALANCES = 4
"""Largest number of descents of that kind, each after leaving a balance; the rest waits for the next call."""

LOWEST = 4
"""Samples near the target from which the closest configuration is looked for where no start is given."""

NEARLY = 1e-3
"""Scaled error above which arms with joints to spare look along the valley and use the list of all solutions, too: for
a stretched arm the last steps of a descent gain less and less."""

SURELY = 1e-9
"""Part of its distance by which a target must lie beyond the reach, rounding excluded, for a search to be pointless."""


@dataclass(frozen=True, eq=False)
class IkResult:
    """The outcome of a solve; a target that cannot be reached is an outcome, too.

    Attributes
    ----------
    success : bool
        Reached inside the limits, within 1e-6 m and 1e-6 rad.
    q : ndarray, shape (n,)
        The solution, or the closest configuration found; rad and m.
    position_error, rotation_error : float
        Metres and radians, of the components the task controls.
    iterations : int
        Steps in all; 0 of a closed form.
    reason : str
        Sentence for the student.
    verdict : Verdict
        The verdict on q, as data.
    proven : bool
        Whether it is certain that no configuration inside the limits reaches the target.
    trace : Trace or None
        Where asked for, the record of the last descent of the search that knows no limits. It may have ended outside
        them; the solution then comes from a descent inside them, or from the list of all solutions. The angles of its
        end may be whole turns from those of ``q``.
    """

    success: bool
    q: NDArray[np.float64]
    position_error: float
    rotation_error: float
    iterations: int
    reason: str
    verdict: Verdict
    proven: bool = False
    trace: Trace | None = None


def solve(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike | None = None,
    method: str = "dls",
    weights: ArrayLike | None = None,
    seed: int = 0,
    locked: Sequence[bool] | None = None,
    searches: int = SEARCHES,
    *,
    trace: bool = False,
    complete: bool = True,
) -> IkResult:
    """Find joint values that put the tool at a pose, as far as the arm's task goes.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world. Components outside the task are ignored, except that with φ the tool
        must not be turned over.
    q0 : array_like, shape (n,), optional
        First start; when left out, of random configurations the one whose tool is nearest, and with ``"dls"`` a closed
        form on its branch comes first where one is quick (see `armlab.kin.ik.at_once`). For a target that cannot be
        reached the result is the closest configuration downhill of it; when left out, the closest that is downhill of
        `LOWEST` of those nearest. Angles of a solution are those nearest to it, whole turns apart, inside the limits;
        in (-pi, pi], where the limits allow, when left out. The closest configuration, and a solution that only the
        way to it finds, stay where that way ends: inside the limits (locked joints apart), but where these are beyond
        half a turn, angles may be outside (-pi, pi] and whole turns from the nearest to ``q0``.
    method : str
        Key of a compiled method (see `methods`) or of an iterative one (see `iteration_methods`; at its default
        parameters, some hundred times slower). ``"gradient"`` and ``"gauss_newton"``, which exist in both forms, mean
        the compiled one.
    weights : array_like, shape (m,), optional
        Positive numbers without unit, one for each component of the arm's task: factors of its errors in half reaches
        (``arm.length_scale`` metres) and radians. They decide which configuration counts as the closest to a target
        that cannot be reached, not what counts as reached. Only their ratios matter; the components of an orientation
        share one.
    seed : int
        Seed of the random starts; the same call gives the same answer.
    locked : sequence of bool, optional
        Joints that keep their value in ``q0``.
    searches : int
        Number of starts, at least 1.
    trace : bool
        Whether to record every step of the last descent; a closed form, which has none, is then left aside.
    complete : bool
        Whether to ask for all solutions when no search succeeds, where the arm has a solver that knows them all.

    Raises
    ------
    InputError
        ``T`` is no pose, an unknown method, shapes or numbers are wrong, or joints are locked without a ``q0``.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> result = solve(arm, arm.fk([0.4, 0.9]), q0=[0.0, 0.5])
    >>> result.success, result.q.round(6).tolist()
    (True, [0.4, 0.9])
    """
    pose = as_pose(T, "T")
    start = None if q0 is None else joint_values(arm, q0, "q0")
    how = checked_how(arm, method, weights, locked, seed, searches, bool(complete), bool(trace))
    return solved(arm, pose, start, how)


class How(NamedTuple):
    """Checked arguments of `solve` besides the pose and the start, as named there."""

    method: str
    weights: Weights | None
    locked: list[bool] | None
    seed: int
    searches: int
    complete: bool
    trace: bool


def checked_how(
    arm: Arm,
    method: str,
    weights: ArrayLike | None,
    locked: Sequence[bool] | None,
    seed: int,
    searches: int,
    complete: bool,
    trace: bool,
) -> How:
    """Return checked arguments; `InputError` when they are wrong."""
    if not isinstance(method, str) or (method not in methods() and method not in iteration_methods()):
        raise UnknownName("method", method, {**methods(), **iteration_methods()})
    return How(
        method,
        checked_weights(arm, weights),
        checked_locks(arm, locked),
        whole_number(seed, "seed", 0),
        whole_number(searches, "searches", 1),
        complete,
        trace,
    )


def solved(arm: Arm, T: NDArray[np.float64], start: NDArray[np.float64] | None, how: How) -> IkResult:
    """Return the outcome for checked arguments; `InputError` when joints are locked without a start."""
    if start is None and how.locked is not None and any(how.locked):
        raise InputError("locked: give q0, the values the locked joints keep")
    task = task_error_of(arm)
    target = task.target(T)
    distance = task.distance(target)
    beyond = distance > arm.reach + REACHED_M + SURELY * distance
    never = beyond or is_turned_over(arm, T)
    pointless = never or (how.locked is not None and all(how.locked))
    begin = Begin(arm, start, how.locked, how.seed, 1 if pointless else how.searches)
    if how.method in methods():
        found = compiled_search(begin, T, target, methods()[how.method], how.trace)
    else:
        found = iterated_search(begin, T, iteration_methods()[how.method], how.trace)
    if found.q is not None and found.verdict is not None:
        return _result(found, found.q, found.verdict, Known())
    problem = problem_of(arm, methods().get(how.method, methods()["dls"]), how.weights)
    descents = [come_closer(problem, target, low, begin.free) for low in begin.lowest(target, LOWEST)]
    rest = min(descents, key=lambda descent: descent.errors.cost)
    found = found._replace(iterations=found.iterations + sum(descent.iterations for descent in descents))
    verdict = judge(arm, T, rest.q, how.locked, how.weights)
    known = Known(None, never, "" if beyond or not never else f"proven: {TURNED_OVER}")
    if not (verdict.reached or never) and how.complete:
        crept = rest.q if rest.errors.scaled2 < NEARLY**2 else None
        known = known_solution(arm, T, begin.near, how.locked, crept)
    if known.q is not None:
        other = judge(arm, T, known.q)
        if other.reached:
            return _result(found, known.q, other, known)
    return _result(found, np.array(rest.q), verdict, known)


def _result(found: Searched, q: NDArray[np.float64], verdict: Verdict, known: Known) -> IkResult:
    reasons = [verdict.reason, known.sentence] if verdict.reached else [verdict.reason, found.note, known.sentence]
    return IkResult(
        success=verdict.reached,
        q=q,
        position_error=verdict.position_error,
        rotation_error=verdict.rotation_error,
        iterations=found.iterations,
        reason="; ".join(reason for reason in reasons if reason),
        verdict=verdict,
        proven=known.proven,
        trace=found.trace,
    )


def come_closer(
    problem: Problem,
    target: Sequence[float],
    q0: ArrayLike,
    free: Sequence[float] | None,
    travel: float = math.inf,
) -> Descent:
    """Go downhill inside the limits from ``q0``, each joint by at most ``travel`` (rad, or length scales).

    A joint that is not free keeps its value, also outside its limits.
    """
    arm, values = problem.arm, np.asarray(q0, dtype=float)
    start = arm.clip(values) if free is None else np.where(np.array(free) == 0.0, values, arm.clip(values))
    box = np.where(arm.revolute, travel, travel * arm.length_scale)
    low = np.maximum(arm.limits[:, 0], start - box)
    high = np.minimum(arm.limits[:, 1], start + box)
    low, high = np.minimum(low, start), np.maximum(high, start)
    inside = low.tolist(), high.tolist()
    found = descend_inside(problem, target, start.tolist(), free, *inside, STEPS_INSIDE)
    if found.converged:
        return found
    closest = closest_of(arm, problem.weights)
    for _ in range(BALANCES):
        rest = descend_inside(closest, target, found.q, free, *inside, STEPS_CLOSEST)
        found = Descent(rest.q, rest.errors, found.iterations + rest.iterations)
        beside = slip(closest, found, target, free, low, high)
        if beside is None:
            break
        found = beside
    return found
