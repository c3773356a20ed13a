"""Arms for tests, and the obvious forward kinematics as a judge."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.dh import link_transform

KINDS = (
    "planar_3r",
    "scara",
    "puma560",
    "ur10e",
    "panda",
    "stanford",
    "cartesian_3p",
    "scorbot",
    "manseur_doty",
)
"""Robots of each structure: planar, SCARA, spherical wrist, three parallel axes, seven joints in the modified
convention, a slide before a wrist, only slides, fewer joints than a pose has numbers, and nothing special."""

QUARTERS = (0.0, np.pi / 2, -np.pi / 2, np.pi)


def random_arm(rng: np.random.Generator, n: int, *, convention: str | None = None, special: bool = False) -> Arm:
    """Return an arm with random rows; ``special`` ones have quarter-turn twists and many zero lengths."""
    rows = []
    for _ in range(n):
        alpha = rng.choice(QUARTERS) if special else rng.uniform(-np.pi, np.pi)
        a, d = rng.uniform(-0.6, 0.6, 2) * (rng.random(2) > (0.5 if special else 0.0))
        theta = rng.choice(QUARTERS) if special else rng.uniform(-np.pi, np.pi)
        rows.append((("R", "R", "P")[rng.integers(3)], float(a), float(alpha), float(d), float(theta)))
    chosen = convention or ("standard", "modified")[rng.integers(2)]
    return Arm.from_dh(rows, chosen, base=random_pose(rng), tool=random_pose(rng))


def random_pose(rng: np.random.Generator) -> np.ndarray:
    """Return a random rigid transform."""
    q = rng.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    T[:3, 3] = rng.uniform(-0.5, 0.5, 3)
    return T


def random_q(arm: Arm, rng: np.random.Generator, count: int | None = None) -> np.ndarray:
    """Return configurations inside the limits."""
    shape = (arm.n,) if count is None else (count, arm.n)
    return rng.uniform(arm.limits[:, 0], arm.limits[:, 1], shape)


def frames_by_products(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Return frames 0 to n as the product of 4 x 4 matrices, one row at a time."""
    T = np.array(arm.base)
    found = [T]
    for row, value in zip(arm.rows, q, strict=True):
        d, theta = (row.d, row.theta + value) if row.revolute else (row.d + value, row.theta)
        T = T @ link_transform(row.a, row.alpha, d, theta, arm.convention)
        found.append(T)
    return np.array(found)


def tool_by_products(arm: Arm, q: np.ndarray) -> np.ndarray:
    """Return the tool pose as a product of matrices."""
    return frames_by_products(arm, q)[-1] @ arm.tool


def jacobian_by_differences(arm: Arm, q: np.ndarray, h: float = 1e-6) -> np.ndarray:
    """Return the geometric Jacobian from central differences of the product of matrices."""
    R = tool_by_products(arm, q)[:3, :3]
    J = np.empty((6, arm.n))
    for i in range(arm.n):
        step = np.zeros(arm.n)
        step[i] = h
        after, before = tool_by_products(arm, q + step), tool_by_products(arm, q - step)
        J[:3, i] = (after[:3, 3] - before[:3, 3]) / (2 * h)
        S = (after[:3, :3] - before[:3, :3]) / (2 * h) @ R.T
        J[3:, i] = [S[2, 1], S[0, 2], S[1, 0]]
    return J


def limited_arm(rng: np.random.Generator, n: int) -> Arm:
    """Return a random arm of n joints, a tenth of them slides, with narrow and wide limits."""
    rows, limits, narrow = [], [], rng.random()
    for _ in range(n):
        a, d = rng.choice([0.0, rng.uniform(0.05, 0.6)]), rng.choice([0.0, rng.uniform(-0.4, 0.4)])
        alpha = rng.choice([*QUARTERS[:3], rng.uniform(-np.pi, np.pi)])
        if rng.random() < 0.1:
            rows.append(("P", a, alpha, 0.0, rng.uniform(-np.pi, np.pi)))
            low, width = rng.uniform(-0.2, 0.2), rng.uniform(0.05, 0.5)
        else:
            rows.append(("R", a, alpha, d, 0.0))
            width = rng.uniform(0.1, 1.0) if rng.random() < narrow else rng.uniform(1.0, 2.0 * np.pi)
            low = rng.uniform(-np.pi, np.pi - width) if width < 2.0 * np.pi else -np.pi
        limits.append((low, low + width))
    return Arm.from_dh(rows, limits=limits)


def wrist_alone(base: np.ndarray, d: float = 0.4) -> Arm:
    """Return a spherical wrist that no joint moves from its place: its linear rows are zero but for rounding."""
    rows = [("R", 0.0, -np.pi / 2, d, 0.0), ("R", 0.0, np.pi / 2, 0.0, 0.0), ("R", 0.0, 0.0, 0.0, 0.0)]
    return Arm.from_dh(rows, base=base)
