"""Judges of lists of solutions."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from support.arms import tool_by_products


def apart(arm: Arm, q: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the largest joint difference of each row of q to one configuration, whole turns apart counting as 0."""
    gap = np.asarray(q) - other
    gap = np.where(arm.revolute, gap - 2.0 * np.pi * np.round(gap / (2.0 * np.pi)), gap)
    return np.abs(gap).max(axis=-1, initial=0.0)


def contains(arm: Arm, q: np.ndarray, one: np.ndarray, tolerance: float = 1e-6) -> bool:
    """Return whether a configuration is among the rows."""
    return len(q) > 0 and bool(apart(arm, q, one).min() < tolerance)


def same_set(arm: Arm, q: np.ndarray, other: np.ndarray, tolerance: float = 1e-6) -> bool:
    """Return whether two lists have the same configurations modulo whole turns."""
    return len(q) == len(other) and all(contains(arm, q, row, tolerance) for row in np.asarray(other))


def worst_error(arm: Arm, q: np.ndarray, T: np.ndarray) -> float:
    """Return the largest error, m and rad, of the components the arm's task controls, by products of matrices."""
    turn = np.linalg.inv(arm.base)
    wanted, worst = turn @ T, 0.0
    for row in q:
        G = turn @ tool_by_products(arm, row)
        worst = max(worst, float(np.abs((G - wanted)[arm.task.coordinates, 3]).max(initial=0.0)))
        R, S = G[:3, :3], wanted[:3, :3]
        if arm.task.rotation == "full":
            worst = max(worst, float(np.abs(R - S).max()))
        elif arm.task.rotation == "approach":
            worst = max(worst, float(np.abs(R[:, 2] - S[:, 2]).max()))
        elif arm.task.rotation == "phi":
            U = S @ R.T
            worst = max(worst, abs(float(np.arctan2(U[1, 0] - U[0, 1], U[0, 0] + U[1, 1]))))
    return worst


def no_duplicates(arm: Arm, q: np.ndarray, tolerance: float = 1e-6) -> bool:
    """Return whether all rows differ."""
    return all(len(q) == k + 1 or apart(arm, q[k + 1 :], q[k]).min() > tolerance for k in range(len(q)))
