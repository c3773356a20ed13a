"""Candidates become solutions: a few Newton steps on the true arm, and its forward kinematics as judge."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

EXACT = 1e-9
"""Metres, for a target farther than a metre times its distance, and radians: the error of a solution."""

GOOD = 1e-13
"""Scaled error at which polishing ends."""

STEPS = 8

CUTOFF = 1e-9
"""Relative singular values below this do not move: along them a singular pose is not told."""

SAME = 1e-6
"""Radians, or length scales: solutions nearer than this in all joints are one."""


def task_errors(arm: Arm, q: Vector, target: list[float]) -> tuple[Vector, Vector, float, float]:
    """Return the scaled J (m, n) and e (m), and the errors in metres and radians; see `TaskError.at`."""
    J, e, errors = task_error_of(arm).at(q.tolist(), target)
    return J, e, errors.position, errors.rotation


def polished(arm: Arm, q: Vector, target: list[float], held: NDArray[np.bool_] | None = None) -> Vector | None:
    """Return the solution at a candidate (n,), or None where the errors do not go below `EXACT`."""
    most = EXACT * max(1.0, math.hypot(*(target[4 * k + 3] for k in arm.task.coordinates)))
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    best, least = q, math.inf
    for _ in range(STEPS):
        J, e, position, rotation = task_errors(arm, q, target)
        size = math.hypot(position / arm.length_scale, rotation)
        if not size < least:
            break
        best, least = q, size
        if size <= GOOD or not math.isfinite(size) or size > 1e-2:
            break
        if held is not None:
            J = np.where(held, 0.0, J)
        q = q + np.linalg.lstsq(J, e, rcond=CUTOFF)[0] * scales
    return best if reaches(arm, best, target, most) else None


def reaches(arm: Arm, q: Vector, target: list[float], most: float = EXACT) -> bool:
    """Return whether joint values (n,) put the tool at the target within ``most`` metres and `EXACT` radians."""
    _, _, position, rotation = task_errors(arm, q, target)
    return position <= most and rotation <= EXACT


def distinct(arm: Arm, candidates: Iterable[Vector]) -> list[Vector]:
    """Return configurations without those that repeat an earlier one, whole turns apart counting as the same."""
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    kept = np.empty((0, arm.n))
    for q in candidates:
        apart = kept - q
        apart = np.where(arm.revolute, apart - math.tau * np.round(apart / math.tau), apart) / scales
        if not len(kept) or float(np.abs(apart).max(axis=1).min()) > SAME:
            kept = np.vstack([kept, q])
    return list(kept)
