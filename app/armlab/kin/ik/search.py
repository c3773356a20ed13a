"""Searches for one solution: descents by a method from one start after the other, until one ends inside the limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.iterate.loop import Fate, Stage, march
from armlab.kin.ik.iterate.method import IterationMethod
from armlab.kin.ik.iterate.problem import Problem as Iterated
from armlab.kin.ik.iterate.record import filmed, replayed, unfit
from armlab.kin.ik.iterate.task_vector import task_vector
from armlab.kin.ik.iterate.trace import Trace
from armlab.kin.ik.loop import descend, wrapped
from armlab.kin.ik.method import Method
from armlab.kin.ik.problem import REACHED_M, REACHED_RAD, Problem
from armlab.kin.ik.verdict import Verdict, free_joints, judge, task_error_of
from armlab.kin.ik.weights import Weights

Floats = NDArray[np.float64]

ITERATIONS = 22
"""Steps of a compiled descent; a start that has not converged by then is replaced by another: cheaper than waiting."""

MOST = 200
"""Steps of one descent of an iterative method; those of first order need a hundred."""

AT_ONCE = 25
"""Starts of an iterative method at most that go together after the first: they share the work of each call."""

TOLERANCE = (0.5 * REACHED_M, 0.5 * REACHED_RAD)
"""Metres and radians at which an iterative method ends: safely within what counts as reached."""


@dataclass(frozen=True, eq=False)
class Begin:
    """Where a search begins, and what holds for all of it.

    Attributes
    ----------
    arm : Arm
    start : ndarray, shape (n,), or None
        First start; random when None.
    locked : list of bool, or None
        Joints that keep their value in ``start``.
    seed, count : int
        Of the starts.
    """

    arm: Arm
    start: Floats | None
    locked: Sequence[bool] | None
    seed: int
    count: int

    @cached_property
    def near(self) -> Floats:
        """Values (n,) that angles stay near to, whole turns apart."""
        return np.zeros(self.arm.n) if self.start is None else self.start

    @cached_property
    def free(self) -> list[float] | None:
        """1 for joints that may move and 0 for others; None when all may."""
        return free_joints(self.locked)

    def starts(self) -> Iterator[Floats]:
        """Yield the starts (n,): the given one, then random ones inside the limits."""
        count = self.count
        if self.start is not None:
            yield self.start
            count -= 1
        rng, (low, width) = np.random.default_rng(self.seed), task_error_of(self.arm).starts
        for _ in range(count):
            yield self._kept(low + width * rng.random(self.arm.n))

    def placed(self, q: Sequence[float]) -> Floats | None:
        """Return the same configuration by whole turns inside the limits; None where there is none."""
        inside = self._kept(wrapped(q, self.near, self.arm.revolute, self.arm.limits))
        return inside if self.arm.within_limits(inside) else None

    def _kept(self, q: Floats) -> Floats:
        return q if self.free is None else np.where(np.array(self.free) == 0.0, self.near, q)


class Searched(NamedTuple):
    """What a search found.

    Attributes
    ----------
    q : ndarray, shape (n,), or None
        A solution inside the limits.
    verdict : Verdict or None
        What it is worth.
    iterations : int
        Steps in all.
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
    q, verdict, path, converged = None, None, None, False
    for start in begin.starts():
        first = start.tolist()
        path = [first] if keep else None
        descent = descend(problem, target, first, free, ITERATIONS, path)
        iterations, converged = iterations + descent.iterations, descent.converged
        q = begin.placed(descent.q) if converged else None
        if q is not None:
            verdict = Verdict("reached", descent.errors.position, descent.errors.rotation, ())
            break
    trace = None if path is None else _replayed(begin, T, method, np.array(path), converged)
    return Searched(q, verdict, iterations, trace)


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
    """Search by an iterative method: the given start first, then many at once until the first of them arrives."""
    problem, values = _iterated(begin, T, method.chord, scaled=False), method.values()
    why_not, iterations, trace = unfit(method, problem.vector, len(problem.free)), 0, None
    starts, count = begin.starts(), 1
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
