"""Candidates become solutions: a few Newton steps on the true arm, and its forward kinematics as judge.

A target is reached within `REACHED_M` and `REACHED_RAD` of `armlab.kin.ik.problem`, here as everywhere. Solutions are
polished to the least error, which is rounding; where two branches would merge just beyond the target, as at a
stretched arm, the configuration between them is as near as can be.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.problem import REACHED_M, Errors
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

ROUNDING = 1e-14
"""Of the distance of a target, in metres: no forward kinematics is better."""

GOOD = 1e-14
"""Scaled error at which polishing ends."""

EXACT = 1e-9
"""Scaled error up to which a candidate is taken for a solution; above, for the nearest to one."""

FAR = 1e-2
"""Scaled error of a candidate that comes from no solution."""

STEPS, MORE_STEPS = 8, 30
"""Of Newton's method; more where the error falls, but only as at a multiple root."""

CUTOFF = 1e-9
"""Relative singular values below this do not move: along them a singular pose is not told."""

WEAK = 0.03
"""The same on the way to the nearest configuration: along weak directions it is at rest."""

SAME = 1e-6
"""Radians, or length scales: points of curves nearer than this in all joints are one."""

CLOSE = 0.3
"""The same, for solutions farther apart, which are not one."""

BETWEEN = 1e-14
"""Scaled error half-way between two candidates, up to which they are one: rounding."""


def polished(
    arm: Arm, q: Vector, target: list[float], held: NDArray[np.bool_] | None = None
) -> tuple[Vector, Errors]:
    """Return the nearest configuration (n,) to a target from a candidate on, and its errors."""
    task = task_error_of(arm)
    scales = np.where(arm.revolute, 1.0, arm.length_scale)

    def descended(q: Vector, cutoff: float, limit: float) -> tuple[Vector, Errors, float]:
        best, least, errors = q, math.inf, task.at(q.tolist(), target)[2]
        for k in range(MORE_STEPS):
            J, e, there = task.at(q.tolist(), target)
            size = math.sqrt(there.scaled2)
            if not size < least or (k >= STEPS and size > 0.5 * least):
                break
            best, least, errors = q, size, there
            if size <= GOOD or size > limit:
                break
            if held is not None:
                J = np.where(held, 0.0, J)
            q = q + np.linalg.lstsq(J, e, rcond=cutoff)[0] * scales
        return best, errors, least

    best, errors, least = descended(q, CUTOFF, FAR)
    if EXACT < least <= FAR:
        nearer, others, less = descended(best, WEAK, math.inf)
        if less < least:
            best, errors = nearer, others
    return best, errors


def is_reached(arm: Arm, errors: Errors, target: list[float]) -> bool:
    """Return whether errors are within what counts as reached; far away, where rounding is more, within that."""
    if errors.reached:
        return True
    distance = math.hypot(*(target[4 * k + 3] for k in arm.task.coordinates))
    return ROUNDING * distance > REACHED_M and errors.position <= ROUNDING * distance and errors.rotation2 < REACHED_M**2


def reaches(arm: Arm, q: Vector, target: list[float]) -> bool:
    """Return whether joint values (n,) put the tool at the target."""
    return is_reached(arm, task_error_of(arm).at(q.tolist(), target)[2], target)


def each_once(arm: Arm, candidates: Sequence[tuple[Vector, Errors]], target: list[float]) -> list[tuple[Vector, Errors]]:
    """Return polished candidates without those that are one with a better one.

    Two are one when half-way between them the error is no larger than theirs, or rounding: where k solutions merge an
    error e of the pose is one of e^(1/k) of the joints, and no distance of the joints tells.
    """
    task = task_error_of(arm)
    ranked = sorted(candidates, key=lambda one: one[1].scaled2)
    kept: list[tuple[Vector, Errors]] = []
    for q, errors in ranked:
        for other, _ in kept:
            apart = _apart(arm, other, q)
            if np.abs(apart).max() > CLOSE:
                continue
            half_way = q + 0.5 * apart * np.where(arm.revolute, 1.0, arm.length_scale)
            between = math.sqrt(task.at(half_way.tolist(), target)[2].scaled2)
            if between <= max(4.0 * math.sqrt(errors.scaled2), BETWEEN):
                break
        else:
            kept.append((q, errors))
    return kept


def distinct(arm: Arm, candidates: Sequence[Vector], tolerance: float = SAME) -> list[Vector]:
    """Return configurations without those that repeat an earlier one, whole turns apart counting as the same."""
    q = np.array(candidates).reshape(-1, arm.n)
    repeats = np.abs(_apart(arm, q[:, None], q)).max(axis=2) <= tolerance
    kept: list[int] = []
    for k in range(len(q)):
        if not repeats[k, kept].any():
            kept.append(k)
    return [q[k] for k in kept]


def _apart(arm: Arm, q: Vector, other: Vector) -> Vector:
    """Return the way from one to the other, without whole turns, slides in length scales."""
    apart = q - other
    return np.where(arm.revolute, apart - math.tau * np.round(apart / math.tau), apart / arm.length_scale)
