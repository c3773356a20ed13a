"""Candidates become solutions: a few Newton steps on the true arm, and its forward kinematics as judge."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.problem import Errors
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

EXACT = 1e-9
"""Metres, for a target farther than a metre times its distance, and radians: the error of a solution."""

GOOD = 1e-13
"""Scaled error at which polishing ends."""

FAR = 1e-2
"""Scaled error of a candidate that comes from no solution."""

STEPS = 8

CUTOFF = 1e-9
"""Relative singular values below this do not move: along them a singular pose is not told."""

SAME = 1e-6
"""Radians, or length scales: solutions nearer than this in all joints are one."""


def polished(arm: Arm, q: Vector, target: list[float], held: NDArray[np.bool_] | None = None) -> Vector | None:
    """Return the solution at a candidate (n,), or None where the errors do not go below `EXACT`."""
    task = task_error_of(arm)
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    best, least, errors = q, math.inf, None
    for _ in range(STEPS):
        J, e, there = task.at(q.tolist(), target)
        size = math.hypot(there.position / arm.length_scale, there.rotation)
        if not size < least:
            break
        best, least, errors = q, size, there
        if size <= GOOD or size > FAR:
            break
        if held is not None:
            J = np.where(held, 0.0, J)
        q = q + np.linalg.lstsq(J, e, rcond=CUTOFF)[0] * scales
    return best if errors is not None and _is_solution(arm, errors, target) else None


def reaches(arm: Arm, q: Vector, target: list[float]) -> bool:
    """Return whether joint values (n,) put the tool at the target within `EXACT`."""
    return _is_solution(arm, task_error_of(arm).at(q.tolist(), target)[2], target)


def _is_solution(arm: Arm, errors: Errors, target: list[float]) -> bool:
    distance = math.hypot(*(target[4 * k + 3] for k in arm.task.coordinates))
    return errors.position <= EXACT * max(1.0, distance) and errors.rotation <= EXACT


def distinct(arm: Arm, candidates: Sequence[Vector], tolerance: float = SAME) -> list[Vector]:
    """Return configurations without those that repeat an earlier one, whole turns apart counting as the same."""
    q = np.array(candidates).reshape(-1, arm.n)
    apart = q[:, None] - q
    apart = np.where(arm.revolute, apart - math.tau * np.round(apart / math.tau), apart / arm.length_scale)
    repeats = np.abs(apart).max(axis=2) <= tolerance
    kept: list[int] = []
    for k in range(len(q)):
        if not repeats[k, kept].any():
            kept.append(k)
    return [q[k] for k in kept]
