"""Candidates become solutions: a few Newton steps on the true arm, and its forward kinematics as judge.

A target is reached within `REACHED_M` and `REACHED_RAD` of `armlab.kin.ik.problem`, here as everywhere. Solutions are
polished to the least error, which is rounding; where two branches would merge just beyond the target, as at a
stretched arm, the configuration between them is as near as can be.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.problem import REACHED_M, Errors
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

ROUNDING = 1e-14
"""Rounding of forward kinematics, relative to the distance of a target in metres."""

GOOD = 1e-13
"""Scaled error at which polishing ends."""

EXACT = 1e-9
"""Scaled error up to which a candidate is a solution; above it may be the configuration nearest to one."""

FAR = 1e-2
"""Scaled error above which a candidate does not belong to a solution."""

STEPS, MORE_STEPS = 8, 60
"""Steps of Newton's method; more where the error falls slowly, as at a multiple root."""

CUTOFF = 1e-9
"""Singular value, relative to the largest, below which a direction is not corrected: it is undetermined at a singular
pose."""

WEAK = (0.03, 1e-3, 1e-5)
"""Singular values, relative to the largest, below which a direction is not corrected on the way to the nearest
configuration, where weak directions are at rest; the best of the results is used."""

SAME = 1e-6
"""Distance in all joints, radians or length scales, below which points of curves are one."""

CLOSE = 0.3
"""Distance in all joints, radians or length scales, up to which two solutions may be one."""

VALLEY, STAYED = 1e-4, 0.1
"""Singular value, relative to the largest, below which a direction is not corrected half-way between two candidates;
and how far to the side the correction may lead, relative to their distance."""

IDENTICAL, BLURRED = 1e-9, 1e-2
"""Distances, in radians or length scales, below which two solutions are one without a test: of exact ones, and of those
that only come near the target."""

BETWEEN = 1e-14
"""Scaled error half-way between two candidates up to which they are one, the difference being rounding."""


class Polished(NamedTuple):
    """The configuration nearest to a target, found from a candidate.

    Attributes
    ----------
    q : ndarray, shape (n,)
    errors : Errors
    J : ndarray, shape (m, n)
        The scaled Jacobian there.
    """

    q: Vector
    errors: Errors
    J: Vector


def polished(arm: Arm, q: Vector, target: list[float], held: NDArray[np.bool_] | None = None) -> Polished:
    """Return the configuration nearest to a target, starting from a candidate (n,); held joints stay."""
    best = _descended(arm, q, target, held, CUTOFF, FAR)
    if EXACT**2 < best.errors.scaled2 <= FAR**2:
        nearer = (_descended(arm, best.q, target, held, weak, math.inf) for weak in WEAK)
        best = min(best, *nearer, key=lambda one: one.errors.scaled2)
    return best


def solution(arm: Arm, q: Vector, target: list[float], held: NDArray[np.bool_] | None = None) -> Vector | None:
    """Return the solution at a candidate (n,), or None when the target is not reached."""
    best = polished(arm, q, target, held)
    return best.q if is_reached(arm, best.errors, target) else None


def _descended(
    arm: Arm,
    q: Vector,
    target: list[float],
    held: NDArray[np.bool_] | None,
    cutoff: float,
    limit: float,
    good: float = GOOD,
) -> Polished:
    """Take Newton steps while they lead nearer and none is good; give up at once when the error exceeds a limit."""
    task, least, best = task_error_of(arm), math.inf, None
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    for k in range(MORE_STEPS):
        J, e, errors = task.at(q.tolist(), target)
        size = math.sqrt(errors.scaled2)
        if best is not None and (not size < least or (k >= STEPS and size > 0.8 * least)):
            break
        best, least = Polished(q, errors, J), size
        if size <= good or not size <= limit:
            break
        q = q + np.linalg.lstsq(J if held is None else np.where(held, 0.0, J), e, rcond=cutoff)[0] * scales
    assert best is not None
    return best


def is_reached(arm: Arm, errors: Errors, target: list[float]) -> bool:
    """Return whether errors are within the tolerance of a reached target, or within rounding when that is larger."""
    if errors.reached:
        return True
    distance = math.hypot(*(target[4 * k + 3] for k in arm.task.coordinates))
    return (
        ROUNDING * distance > REACHED_M and errors.position <= ROUNDING * distance and errors.rotation2 < REACHED_M**2
    )


def reaches(arm: Arm, q: Vector, target: list[float]) -> bool:
    """Return whether joint values (n,) bring the tool to the target."""
    return is_reached(arm, task_error_of(arm).at(q.tolist(), target)[2], target)


def each_once(arm: Arm, candidates: Sequence[Polished], target: list[float]) -> list[Polished]:
    """Return polished candidates without those that coincide with a better one.

    Two are one when half-way between them the error is no larger than theirs, or rounding: where k solutions merge an
    error e of the pose is one of e^(1/k) of the joints, and no distance of the joints tells.
    """
    ranked = sorted(candidates, key=lambda one: one.errors.scaled2)
    rows = np.array([one.q for one in ranked]).reshape(-1, arm.n)
    ways = _apart(arm, rows[:, None], rows)
    close = np.abs(ways).max(axis=2, initial=0.0) <= CLOSE
    kept: list[int] = []
    for k, one in enumerate(ranked):
        if not any(close[k, j] and _joined(arm, one, ways[k, j], target) for j in kept):
            kept.append(k)
    return [ranked[k] for k in kept]


def _joined(arm: Arm, one: Polished, way: Vector, target: list[float]) -> bool:
    """Return whether half-way from another solution, ``way`` before one, the arm still reaches the target.

    Candidates of high multiplicity lie in a bent valley: its bottom beside the middle of the chord counts.
    """
    far = float(np.abs(way).max())
    if far < (BLURRED if one.errors.scaled2 > EXACT**2 else IDENTICAL):
        return True
    half_way = one.q - 0.5 * way * np.where(arm.revolute, 1.0, arm.length_scale)
    between = _descended(arm, half_way, target, None, VALLEY, math.inf, 0.0)
    aside = np.abs(_apart(arm, between.q, half_way)).max()
    return bool(aside < STAYED * far and between.errors.scaled2 <= max(16.0 * one.errors.scaled2, BETWEEN**2))


def distinct(arm: Arm, candidates: Sequence[Vector], tolerance: float = SAME) -> list[Vector]:
    """Return configurations (n,) without those that repeat an earlier one, up to whole turns."""
    q = np.array(candidates).reshape(-1, arm.n)
    repeats = np.abs(_apart(arm, q[:, None], q)).max(axis=2) <= tolerance
    kept: list[int] = []
    for k in range(len(q)):
        if not repeats[k, kept].any():
            kept.append(k)
    return [q[k] for k in kept]


def _apart(arm: Arm, q: Vector, other: Vector) -> Vector:
    """Return the difference of two configurations without whole turns, slides in length scales."""
    apart = q - other
    return np.where(arm.revolute, apart - math.tau * np.round(apart / math.tau), apart / arm.length_scale)
