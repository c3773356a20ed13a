"""Singular configurations that one joint reaches while the others stay: near the present one, or over its range."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import finite_floats
from armlab.kin.control.scaled_task import ScaledTask

Floats = NDArray[np.float64]

SINGULAR = 1e-9
"""Inverse condition at and below which a configuration that was looked for has been found."""

STEPS = 12
"""Of Newton's method on one singular value; it doubles its digits with each."""

NEAR_ENOUGH = 0.05
"""Inverse condition at a sampled minimum from which Newton's method is tried."""

SAMPLES = 49
DIFFERENCE = 1e-5
"""Radians, or length scales: of central differences of the Jacobian."""

FAR = 0.6
"""Radians, or length scales: a singular configuration farther away is not near."""

TRIED = 2.0 * FAR
"""How far Newton's method may look: where the singular value bends, its first step is too long."""


class SingularPose(NamedTuple):
    """A singular configuration.

    Attributes
    ----------
    q : ndarray, shape (n,)
        rad or m.
    joint : int
        0-based: the only one that differs from where it was looked for.
    away : float
        Its value there minus its value before, rad or m.
    """

    q: Floats
    joint: int
    away: float


def nearest_singular_pose(task: ScaledTask, q: ArrayLike) -> SingularPose | None:
    """Return the singular configuration that the least motion of one joint leads to; None where none is near.

    Newton's method on the smallest singular value, whose derivative is u^T (dJ/dq_k) v, for each joint k that changes
    it. It takes the shortest way by angles; one metre of a sliding joint counts as its share of the length scale. What
    it finds lies inside the limits of the joint.

    Parameters
    ----------
    task : ScaledTask
    q : array_like, shape (n,)
        Radians and metres.

    References
    ----------
    Derivative of a singular value: Stewart and Sun, *Matrix Perturbation Theory*, 1990, section IV.2.
    """
    values = finite_floats(q, "q", (task.n,), f"{task.n} finite numbers")
    U, sigma, V = _decomposed(task, values)
    if sigma[-1] <= SINGULAR * sigma[0]:
        return SingularPose(values, 0, 0.0)
    found = []
    for k in np.argsort([-abs(_slope(task, values, k, U, V)) for k in range(task.n)]).tolist():
        pose = _along(task, values, k)
        if pose is not None:
            found.append(pose)
    return min(found, key=lambda pose: _distance(task, pose), default=None)


def singular_poses(task: ScaledTask, q: ArrayLike) -> tuple[SingularPose, ...]:
    """Return the singular configurations that each joint meets in its range while the others are as in q.

    In the order of the joints. A joint whose motion changes no singular value meets none. Two that are closer to each
    other than a sample of the range may be found as one.

    Parameters
    ----------
    task : ScaledTask
    q : array_like, shape (n,)
        Radians and metres.
    """
    values = finite_floats(q, "q", (task.n,), f"{task.n} finite numbers")
    found: list[SingularPose] = []
    for k in range(task.n):
        low, high = task.arm.limits[k]
        grid = np.linspace(low, high, SAMPLES)
        inverse = np.array([_inverse_condition(task, _with(values, k, float(at))) for at in grid])
        if inverse.max() <= SINGULAR:
            continue
        walled = np.concatenate([[np.inf], inverse, [np.inf]])
        dips = np.flatnonzero((inverse < walled[:-2]) & (inverse <= walled[2:]) & (inverse < NEAR_ENOUGH))
        same = 0.5 * (high - low) / (SAMPLES - 1)
        for at in grid[dips].tolist():
            pose = _along(task, _with(values, k, at), k)
            if pose is None or any(one.joint == k and abs(one.q[k] - pose.q[k]) < same for one in found):
                continue
            found.append(SingularPose(pose.q, k, float(pose.q[k] - values[k])))
    return tuple(found)


def _along(task: ScaledTask, q: Floats, k: int) -> SingularPose | None:
    """Return where joint k meets a singularity near q, inside its limits; None where it does not."""
    low, high = task.arm.limits[k]
    at = q.copy()
    for _ in range(STEPS):
        U, sigma, V = _decomposed(task, at)
        if sigma[-1] <= SINGULAR * sigma[0]:
            away = float(at[k] - q[k])
            return SingularPose(at, k, away) if abs(away) <= FAR * task.joint_units[k] else None
        slope = _slope(task, at, k, U, V)
        if abs(slope) * TRIED < sigma[-1]:
            return None
        before = float(at[k])
        after = before - float(sigma[-1]) / slope * float(task.joint_units[k])
        at[k] = min(max(after, low), high)
        # A singularity may lie exactly at a limit, so a step beyond it goes on from there, once.
        stuck = at[k] == before and after != before
        if stuck or abs(at[k] - q[k]) > TRIED * task.joint_units[k]:
            return None
    return None


def _slope(task: ScaledTask, q: Floats, k: int, U: Floats, V: Floats) -> float:
    """Return the derivative of the smallest singular value by the scaled value of joint k."""
    step = DIFFERENCE * float(task.joint_units[k])
    ahead, behind = (task.scaled(task.jacobian(_with(q, k, float(q[k]) + side * step))) for side in (1.0, -1.0))
    return float(U @ (ahead - behind) @ V) / (2.0 * DIFFERENCE)


def _decomposed(task: ScaledTask, q: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the singular vectors u (m,) and v (n,) of the smallest singular value, and all singular values."""
    U, sigma, V_T = np.linalg.svd(task.scaled(task.jacobian(q)), full_matrices=False)
    return U[:, -1], sigma, V_T[-1]


def _inverse_condition(task: ScaledTask, q: Floats) -> float:
    sigma = np.linalg.svd(task.scaled(task.jacobian(q)), compute_uv=False)
    return float(sigma[-1] / sigma[0]) if sigma[0] > 0.0 else 0.0


def _with(q: Floats, k: int, value: float) -> Floats:
    changed = q.copy()
    changed[k] = value
    return changed


def _distance(task: ScaledTask, pose: SingularPose) -> float:
    return abs(pose.away) / float(task.joint_units[pose.joint])
