"""Searches for one solution: descents by a method from one start after another, until one ends inside the limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.at_once import at_once
from armlab.kin.ik.iterate.loop import Fate, Stage, march
from armlab.kin.ik.iterate.method import IterationMethod
from armlab.kin.ik.iterate.problem import Problem as Iterated
from armlab.kin.ik.iterate.record import filmed, replayed, unfit
from armlab.kin.ik.iterate.task_vector import task_vector
from armlab.kin.ik.iterate.trace import Trace
from armlab.kin.ik.loop import Descent, arrived, descend, descend_inside, turns_inside
from armlab.kin.ik.method import Method
from armlab.kin.ik.problem import REACHED_M, REACHED_RAD, Problem
from armlab.kin.ik.rest import AT
from armlab.kin.ik.samples import samples_of
from armlab.kin.ik.verdict import Verdict, free_joints, judge, task_error_of
from armlab.kin.ik.weights import Weights

Floats = NDArray[np.float64]

ITERATIONS = 22
"""Largest number of steps of a compiled descent; after that another start is cheaper than waiting."""

MOST = 200
"""Largest number of steps of one descent of an iterative method; those of first order need a hundred."""

POLISH = 3
"""Largest number of steps for a solution in closed form."""

NEAR = 8
"""Number of starts from samples near the target; more of them would lead to the same solutions."""

FREELY = 2
"""Samples from which an arm with joints to spare descends without limits only, which is quick; from later ones it also
descends inside them, which is slower but finds a solution where few are inside."""

STAGE, STAGES = 5, 10
"""Steps in a stage of a descent inside the limits, and number of stages: it goes on while each stage halves its squared
error. One that crawls along limits is replaced by another sooner than it would arrive."""

AT_ONCE = 25
"""Largest number of starts of an iterative method that go together after the first: they share the work of each
call."""

TOLERANCE = (0.5 * REACHED_M, 0.5 * REACHED_RAD)
"""Errors, in metres and radians, at which an iterative method ends: safely within those of a reached target."""


class Begin:
    """The start of a search, and the arguments common to all of it.

    Attributes
    ----------
    arm : Arm
    start : ndarray, shape (n,), or None
        First start; a sample near the target when None.
    seed, count : int
        Seed and number of the starts.
    near : ndarray, shape (n,)
        Values that angles stay near to, whole turns apart.
    free : list of float, or None
        1 for joints that may move and 0 for those that keep their value in ``start``; None when all may.
    has_spare_joints : bool
        Whether more joints may move than the task has components: an arm at its limits can then still go on.
    """

    def __init__(self, arm: Arm, start: Floats | None, locked: Sequence[bool] | None, seed: int, count: int) -> None:
        self.arm, self.start, self.seed, self.count = arm, start, seed, count
        self.near = np.zeros(arm.n) if start is None else start
        self.free = free_joints(locked)
        self.has_spare_joints = (arm.n if self.free is None else sum(self.free)) > arm.task.m

    def starts(self, target: Sequence[float]) -> Iterator[list[float]]:
        """Yield the starts: the given one, then samples whose tool is near the target, then random ones."""
        count = self.count
        if self.start is not None:
            yield self.start.tolist()
            count -= 1
        # With joints held the tools of the samples are elsewhere.
        if count > 0 and self.free is None:
            samples = samples_of(self.arm, self.seed)
            yield samples.nearest(target).tolist()
            near = samples.near(target, min(count, NEAR))[1:]
            yield from near.tolist()
            count -= 1 + len(near)
        rng, (low, width) = np.random.default_rng(self.seed), task_error_of(self.arm).starts
        for _ in range(count):
            yield self._kept(low + width * rng.random(self.arm.n)).tolist()

    def lowest(self, target: Sequence[float], count: int) -> Floats:
        """Return where to go downhill from, (k, n): the given start, or so many samples whose tool is nearest."""
        if self.start is not None or self.free is not None:
            return self.near[None]
        return samples_of(self.arm, self.seed).near(target, count)

    def placed(self, q: Sequence[float]) -> Floats | None:
        """Return the configuration (n,) moved by whole turns inside the limits; None when that is impossible."""
        near, free, inside = self.near.tolist(), self.free, list(q)
        for i, (low, high, turns) in enumerate(task_error_of(self.arm).ranges):
            if free is not None and not free[i]:
                inside[i] = near[i]
            elif turns:
                inside[i] += turns_inside(inside[i], near[i], low, high)
            if not low - AT <= inside[i] <= high + AT:
                return None
        return np.array(inside)

    def limits(self, q: Sequence[float]) -> tuple[list[float], list[float]]:
        """Return the least and greatest values of a descent inside the limits; held joints stay, even outside."""
        low, high, _ = map(list, zip(*task_error_of(self.arm).ranges, strict=True))
        for i, may in enumerate(self.free or ()):
            if not may:
                low[i] = high[i] = q[i]
        return low, high

    def _kept(self, q: Floats) -> Floats:
        return q if self.free is None else np.where(np.array(self.free) == 0.0, self.near, q)


class Searched(NamedTuple):
    """The result of a search.

    Attributes
    ----------
    q : ndarray, shape (n,), or None
        A solution inside the limits.
    verdict : Verdict or None
        The verdict on the configuration.
    iterations : int
        Steps in all; 0 of a closed form.
    trace : Trace or None
        Record of the last descent.
    note : str
        Why the method could not be used; empty when it could.
    """

    q: Floats | None
    verdict: Verdict | None
    iterations: int
    trace: Trace | None
    note: str = ""


def problem_of(arm: Arm, method: Method, weights: Weights | None = None) -> Problem:
    """Return the compiled problem of an arm (arms are compared by identity)."""
    return _problem_of(arm, method, weights)


@lru_cache(maxsize=64)
def _problem_of(arm: Arm, method: Method, weights: Weights | None) -> Problem:
    return Problem(arm, method, weights)


def compiled_search(begin: Begin, T: Floats, target: Sequence[float], method: Method, keep: bool) -> Searched:
    """Search by a compiled method; with ``keep`` its last descent is recorded.

    Parameters
    ----------
    T : ndarray, shape (4, 4)
        Checked pose in the world.
    target : sequence of 12 floats
        The same as the formulas want it, see `TaskError.target`.
    """
    problem, free, iterations = problem_of(begin.arm, method), begin.free, 0
    found, path, converged = None, None, False
    # For methods without damping students want to see the method itself, and for a record its steps.
    if begin.start is None and method.damped and not keep:
        found = _found_at_once(begin, problem, T, target)
    for number, first in enumerate(begin.starts(target) if found is None else ()):
        path = [first] if keep else None
        descent = descend(problem, target, first, free, ITERATIONS, path)
        iterations, converged = iterations + descent.iterations, descent.converged
        found = _reached(begin, descent)
        if found is None and begin.has_spare_joints and (number >= FREELY or begin.start is not None):
            descent = _descend_inside(begin, problem, target, first)
            iterations += descent.iterations
            found = _reached(begin, descent)
        if found is not None:
            break
    trace = None if path is None else _replayed(begin, T, method, np.array(path), converged)
    q, verdict = (None, None) if found is None else found
    return Searched(q, verdict, iterations, trace)


def _found_at_once(begin: Begin, problem: Problem, T: Floats, target: Sequence[float]) -> tuple[Floats, Verdict] | None:
    """Return a solution inside the limits on a branch near the best sample, if it is quick to find."""
    solver = at_once(begin.arm)
    if solver is None:
        return None
    near = samples_of(begin.arm, begin.seed).nearest(target).tolist()
    for q in solver.solutions(problem.in_frame_0(T), near):
        if begin.placed(q) is None:
            continue
        errors = problem.errors_at(q, target)
        # Rounding of a nearly straight elbow or wrist is polished away.
        descent = Descent(q, errors, 0) if arrived(errors) else descend(problem, target, q, None, POLISH)
        found = _reached(begin, descent)
        if found is not None:
            return found
    return None


def inside_solutions(begin: Begin, target: Sequence[float], method: Method, wanted: int) -> list[Floats]:
    """Return solutions (n,) found by descents inside the limits: ``wanted`` of them, or as many as the starts give."""
    problem, found = problem_of(begin.arm, method), []
    for first in begin.starts(target):
        reached = _reached(begin, _descend_inside(begin, problem, target, first))
        if reached is not None:
            found.append(reached[0])
            if len(found) == wanted:
                break
    return found


def _descend_inside(begin: Begin, problem: Problem, target: Sequence[float], first: Sequence[float]) -> Descent:
    """Return the end of a descent inside the limits, which is given up when it crawls."""
    low, high = begin.limits(first)
    cost, iterations, q = math.inf, 0, list(first)
    for _ in range(STAGES):
        descent = descend_inside(problem, target, q, begin.free, low, high, STAGE)
        iterations, q = iterations + descent.iterations, descent.q
        if descent.converged or descent.iterations < STAGE or descent.errors.cost > 0.5 * cost:
            break
        cost = descent.errors.cost
    return Descent(q, descent.errors, iterations)


def _reached(begin: Begin, descent: Descent) -> tuple[Floats, Verdict] | None:
    """Return the solution at the end of a descent and its verdict; None when it is not inside the limits."""
    q = begin.placed(descent.q) if descent.converged else None
    if q is None:
        return None
    return q, Verdict("reached", descent.errors.position, descent.errors.rotation, ())


def _replayed(begin: Begin, T: Floats, method: Method, path: Floats, converged: bool) -> Trace:
    def damping(square: Floats) -> Floats:
        assert method.damping is not None
        return np.asarray(method.damping(square, method.gain))

    problem = _iterated(begin, T, chord=True, scaled=True)
    added = damping if method.damped else None
    return replayed(problem, method.key, {"gain": method.gain}, path, added, converged)


def _iterated(begin: Begin, T: Floats, chord: bool, scaled: bool) -> Iterated:
    arm = begin.arm
    free = [i for i in range(arm.n) if begin.free is None or begin.free[i]]
    return Iterated(arm, T, task_vector(arm), free, clamp=False, chord=chord, scaled=scaled)


def iterated_search(begin: Begin, T: Floats, method: IterationMethod, keep: bool) -> Searched:
    """Search by an iterative method: from the given start first, then from many at once until one arrives."""
    problem, values = _iterated(begin, T, method.chord, scaled=False), method.values()
    why_not, iterations, trace = unfit(method, problem.vector, len(problem.free)), 0, None
    starts, count = begin.starts(task_error_of(begin.arm).target(T)), 1
    while batch := list(islice(starts, count)):
        stages: list[Stage] = []
        for stage in march(problem, method, values, np.array(batch), 0 if why_not else MOST, TOLERANCE):
            if keep:
                stages.append(stage)
            iterations += int(np.sum(stage.fate == Fate.GOING))
            for i in np.flatnonzero(stage.fate == Fate.CONVERGED).tolist():
                q = begin.placed(stage.point.q[i].tolist())
                if q is not None:
                    trace = filmed(problem, method, values, stages, int(stage.rows[i])) if keep else None
                    return Searched(q, judge(begin.arm, T, q), iterations, trace)
        trace = filmed(problem, method, values, stages, len(batch) - 1, why_not) if keep else None
        if why_not:
            return Searched(None, None, iterations, trace, why_not[1])
        count = AT_ONCE
    return Searched(None, None, iterations, trace)
