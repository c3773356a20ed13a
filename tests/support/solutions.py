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


def by_many_starts(arm: Arm, T: np.ndarray, starts: int = 1000, seed: int = 0, steps: int = 60) -> np.ndarray:
    """Return every solution for a whole pose that damped Newton steps reach from random starts, shape (k, n).

    Written apart from what it judges: only the arm's forward kinematics and Jacobian, whole batches, no cleverness.
    """
    rng, L = np.random.default_rng(seed), arm.length_scale
    low, high = np.where(arm.revolute, -np.pi, arm.limits[:, 0]), np.where(arm.revolute, np.pi, arm.limits[:, 1])
    q = rng.uniform(low, high, (starts, arm.n))
    scales = np.where(arm.revolute, 1.0, L)
    units = np.array([1.0 / L] * 3 + [1.0] * 3)
    done = []
    for _ in range(steps):
        tool, J = np.asarray(arm.fk(q)), np.asarray(arm.jacobian(q)) * units[:, None] * scales
        R = tool[:, :3, :3]
        axis = 0.5 * np.cross(R, np.broadcast_to(T[:3, :3], R.shape), axis=1).sum(axis=2)
        cosine = 0.5 * (np.einsum("kij,ij->k", R, T[:3, :3]) - 1.0)
        turn = axis / np.sqrt(np.maximum(0.5 + 0.5 * cosine, 1e-9))[:, None]
        e = np.concatenate([(T[:3, 3] - tool[:, :3, 3]) / L, turn], axis=1)
        size = np.linalg.norm(e, axis=1)
        near = size < 1e-11
        done.append(q[near])
        q, J, e, size = q[~near], J[~near], e[~near], size[~near]
        if not len(q):
            break
        normal = J @ np.swapaxes(J, 1, 2) + (0.1 * size**2 + 1e-14)[:, None, None] * np.eye(6)
        step = np.einsum("kij,ki->kj", J, np.linalg.solve(normal, e[..., None])[..., 0])
        q = q + np.clip(step, -1.5, 1.5) * scales
    found: list[np.ndarray] = []
    for row in np.vstack(done):
        if not contains(arm, np.array(found), row, 1e-5):
            found.append(row)
    return np.array(found).reshape(-1, arm.n)
