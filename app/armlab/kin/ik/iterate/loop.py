"""The shared loop: one method from many starts at once, each until it ends for a reason of its own.

Every step is taken as the method proposes it, cut off at the joint limits at most, so that a lesson shows the method
and not the care around it; `armlab.kin.ik.loop` is the loop that takes care.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameters
from armlab.kin.ik.iterate.problem import Floats, Point, Problem

FLAT = 1e-12
"""Slope |J^T e|, relative to sigma_max |e|, below which it is zero but for rounding."""

STILL = 1e-9
"""Scaled joint change that counts as no motion where the slope is zero."""

SETTLED = 1e-4
"""Self-motion of one step, in scaled joints, below which a secondary objective counts as reached."""

GROWN = 1e8
"""Scaled error, relative to the first one, above which an iteration has diverged."""

FARTHEST = 1e9
"""Scaled joint value above which sines have lost their digits."""


class Fate(IntEnum):
    """State of an iteration."""

    GOING = 0
    CONVERGED = 1
    STUCK = 2
    SINGULAR = 3
    REPRESENTATION = 4
    DIVERGED = 5
    LIMIT = 6
    MOST = 7


class Stage(NamedTuple):
    """One iterate of all starts that still went on, and the step taken from it.

    Attributes
    ----------
    rows : ndarray of int, shape (B,)
        Indices of the starts.
    point : Point
    landed : ndarray, shape (B, n)
        Ends of the steps; the same configuration for iterations that end here.
    damping : ndarray, shape (B,)
    fate : ndarray of int, shape (B,)
        `Fate` after this iterate.
    """

    rows: NDArray[np.intp]
    point: Point
    landed: Floats
    damping: Floats
    fate: NDArray[np.intp]


def march(
    problem: Problem,
    method: IterationMethod,
    parameters: Parameters,
    starts: Floats,
    most: int,
    tolerance: tuple[float, float],
) -> Iterator[Stage]:
    """Yield the stages of an iteration from starts (B, n) until all have ended.

    Parameters
    ----------
    most : int
        Largest number of steps.
    tolerance : (float, float)
        Metres and radians within which a target is reached; each kind is looked at for itself.
    """
    q, rows, memory = starts, np.arange(len(starts)), _NONE
    first = np.zeros(len(starts))
    for k in range(most + 1):
        point, size = _evaluated(problem, q)
        if k == 0:
            first = np.maximum(size, min(tolerance))
        reached: NDArray[np.bool_] = within(problem, point, tolerance)
        fate = np.full(len(q), int(Fate.GOING))
        fate[~(size <= GROWN * first)] = Fate.DIVERGED
        fate[~point.represented] = Fate.REPRESENTATION
        if method.objective is None or k == most:
            fate[reached] = Fate.CONVERGED
        if k == most:
            fate[fate == Fate.GOING] = Fate.MOST
        landed, damping = q.copy(), np.zeros(len(q))
        go = np.flatnonzero(fate == Fate.GOING)
        if len(go):
            part, held = point.take(go), tuple(one[go] for one in memory)
            # Steps from nearly singular matrices may overflow; where they do, the iteration has diverged.
            with np.errstate(all="ignore"):
                move = method.step(problem, part, parameters, held)
                landed[go], fate[go] = _landed(problem, method, part, move, reached[go])
            damping[go] = 0.0 if move.damping is None else move.damping
            memory = move.memory
        yield Stage(rows, point, landed, damping, fate)
        on = fate == Fate.GOING
        memory = tuple(one[on[go]] for one in memory)
        q, rows, first = landed[on], rows[on], first[on]
        if not len(rows):
            return


_NONE: Memory = ()


def _evaluated(problem: Problem, q: Floats) -> tuple[Point, Floats]:
    point = problem.at(q)
    with np.errstate(over="ignore"):
        return point, np.linalg.norm(point.e, axis=-1)


def within(problem: Problem, point: Point, tolerance: tuple[float, float]) -> NDArray[np.bool_]:
    """Return where (B,) every error is within its tolerance, in metres and radians separately."""
    metres, radians = tolerance
    reached = (point.misfit.position <= metres) & (point.misfit.rotation <= radians)
    own = problem.vector.task.m
    for i, kind in enumerate(problem.kinds[own:]):
        reached &= np.abs(point.misfit.components[:, own + i]) <= (metres if kind == "m" else radians)
    return reached


def _landed(
    problem: Problem, method: IterationMethod, point: Point, move: Move, reached: NDArray[np.bool_]
) -> tuple[Floats, NDArray[np.intp]]:
    """Return the ends of the steps and the states of the iterations; one that ends does not move."""
    fate, flat = np.full(len(point.q), int(Fate.GOING)), is_flat(point)
    finite = np.asarray(np.all(np.isfinite(move.dq), axis=-1))
    dq = np.where(finite[:, None], move.dq, 0.0)
    landed = problem.land(point.q, dq)
    largest = np.max(np.abs(dq), axis=-1)
    far = np.max(np.abs(problem.travelled(np.zeros_like(landed), landed)), axis=-1) > FARTHEST
    fate[~np.any(landed != point.q, axis=-1)] = Fate.LIMIT
    fate[(flat & (largest <= STILL)) | (largest == 0.0)] = Fate.STUCK
    if move.refused is not None:
        fate[move.refused] = np.where(flat, int(Fate.STUCK), int(Fate.SINGULAR))[move.refused]
    fate[~finite | far] = Fate.DIVERGED
    if method.objective is not None and move.secondary is not None:
        unmoved = (fate == Fate.LIMIT) | (fate == Fate.STUCK)
        fate[reached & ((move.secondary <= SETTLED) | unmoved)] = Fate.CONVERGED
    return np.where((fate == Fate.GOING)[:, None], landed, point.q), fate


def is_flat(point: Point) -> NDArray[np.bool_]:
    """Return where J^T e is zero though e is not, (B,): to first order no small motion comes closer."""
    with np.errstate(over="ignore", invalid="ignore"):
        slope, e = np.linalg.norm(point.slope, axis=-1), np.linalg.norm(point.e, axis=-1)
        return np.asarray(slope <= FLAT * point.sigma_max * e)
