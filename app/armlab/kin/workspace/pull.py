"""Inverse kinematics of many configurations at once, always inside the limits, by which a section is verified.

Levenberg's method. A step is taken only when it comes nearer; joints at a limit that would push outward are held.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint

Floats = NDArray[np.float64]
Residual = Callable[[Floats, NDArray[np.intp]], Floats]
Rates = Callable[[Floats, NDArray[np.intp]], Floats]

ITERATIONS = 14
"""Largest number of iterations, enough for targets within a few cells; others are reached from elsewhere."""

USUAL_JOINTS = 6
"""Number of joints above which fewer configurations are pulled in one piece of work."""

LONGEST = 0.5
"""Largest change of a joint in one step, radians or length scales."""

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-3, 1e-9, 1e3
"""First, least and greatest damping, relative to the mean square of the singular values."""

HARDER, EASIER = 8.0, 0.15
"""Factors of the damping after a step that led away, and after one that came nearer."""


def pieces(joint: FirstJoint, count: int, most: int) -> Iterator[slice]:
    """Yield slices of ``count`` configurations to pull in one piece of work, at most ``most`` of them each."""
    size = most * USUAL_JOINTS // max(joint.arm.n, USUAL_JOINTS)
    for first in range(0, count, size):
        yield slice(first, first + size)


def pull(
    joint: FirstJoint,
    q: Floats,
    targets: Floats,
    tolerance: float,
    *,
    iterations: int = ITERATIONS,
    weights: Floats | None = None,
) -> tuple[Floats, Floats]:
    """Return configurations pulled towards points of the section by the joints after the first, inside their limits.

    Parameters
    ----------
    joint : FirstJoint
    q : ndarray, shape (k, n)
        Inside the limits but for joint 1, which stays as it is.
    targets : ndarray, shape (k, 2)
        (u, v) in metres.
    tolerance : float
        Metres from the target that are near enough.
    iterations : int
    weights : ndarray, shape (k, 2), optional
        Weights of u and of v; equal by default.

    Returns
    -------
    q : ndarray, shape (k, n)
    error : ndarray, shape (k,)
        Metres left.
    """
    weighing = np.ones((len(q), 2)) if weights is None else weights

    def residual(values: Floats, rows: NDArray[np.intp]) -> Floats:
        return np.asarray((targets[rows] - joint.split(joint.arm.position(values))[:, :2]) * weighing[rows])

    def rates(values: Floats, rows: NDArray[np.intp]) -> Floats:
        return np.asarray(section_rates(joint, values) * weighing[rows][:, :, None])

    return least_squares(joint, q, residual, rates, joint.moving, tolerance, iterations)


def pull_in_space(
    joint: FirstJoint, q: Floats, points: Floats, tolerance: float, *, iterations: int = 3 * ITERATIONS
) -> tuple[Floats, Floats]:
    """Return configurations pulled towards points of the world, shape (k, 3), by all joints; and metres left (k,)."""

    def residual(values: Floats, rows: NDArray[np.intp]) -> Floats:
        return np.asarray(points[rows] - joint.arm.position(values))

    def rates(values: Floats, rows: NDArray[np.intp]) -> Floats:
        return np.asarray(joint.arm.jacobian(values)[:, :3, :])

    return least_squares(joint, q, residual, rates, tuple(range(joint.arm.n)), tolerance, iterations)


def section_rates(joint: FirstJoint, q: Floats) -> Floats:
    """Return d(u, v)/dq, shape (k, 2, n), in metres per radian or metre."""
    J = np.asarray(joint.arm.jacobian(q)[:, :3, :])
    if not joint.revolute:
        return np.asarray(joint.axes[:, :2].T @ J)
    s = joint.split(joint.arm.position(q))[:, 2]
    outward = np.cos(s)[:, None] * joint.axes[:, 0] + np.sin(s)[:, None] * joint.axes[:, 1]
    return np.stack([np.einsum("ka,kan->kn", outward, J), np.einsum("a,kan->kn", joint.axes[:, 2], J)], axis=1)


def least_squares(
    joint: FirstJoint,
    q: Floats,
    residual: Residual,
    rates: Rates,
    joints: tuple[int, ...],
    tolerance: float,
    iterations: int,
) -> tuple[Floats, Floats]:
    """Return configurations with the least residual (k, r) that some joints can reach, and its length."""
    q = np.array(q, dtype=np.float64)
    rows = np.arange(len(q))
    e = residual(q, rows)
    error = np.linalg.norm(e, axis=-1)
    damping = np.full(len(q), FIRST_DAMPING)
    moving = list(joints)
    low, high = joint.arm.limits[moving].T
    scale = np.where(joint.arm.revolute[moving], 1.0, joint.arm.length_scale)
    for _ in range(iterations if moving else 0):
        rows = np.flatnonzero((error > tolerance) & (damping < MOST_DAMPING))
        if not rows.size:
            break
        J = rates(q[rows], rows)[..., moving] * scale
        here = q[rows][:, moving]
        step = _step(J, e[rows], damping[rows], here <= low, here >= high) * scale
        trial = q[rows]
        trial[:, moving] = np.clip(here + step, low, high)
        left = residual(trial, rows)
        length = np.linalg.norm(left, axis=-1)
        nearer = length < error[rows]
        taken = rows[nearer]
        q[taken], e[taken], error[taken] = trial[nearer], left[nearer], length[nearer]
        damping[rows] = np.where(nearer, np.maximum(damping[rows] * EASIER, LEAST_DAMPING), damping[rows] * HARDER)
    return q, error


def _step(J: Floats, e: Floats, damping: Floats, at_low: NDArray[np.bool_], at_high: NDArray[np.bool_]) -> Floats:
    """Return damped steps (k, m), solved again without the joints that would be pushed through a limit."""
    r = J.shape[1]
    mean_square = np.einsum("kij,kij->k", J, J) / r
    ridge = (damping * mean_square + np.finfo(np.float64).tiny ** 0.5)[:, None, None] * np.eye(r)
    free = np.ones(at_low.shape)
    step = np.zeros(at_low.shape)
    for _ in range(2):
        held = J * free[:, None, :]
        square = held @ held.transpose(0, 2, 1) + ridge
        step = np.einsum("kij,ki->kj", held, _solved(square, e))
        outward = (at_low & (step < 0.0)) | (at_high & (step > 0.0))
        if not outward.any():
            break
        free = np.where(outward, 0.0, free)
    step *= free
    longest = np.abs(step).max(axis=1, keepdims=True)
    return np.asarray(step * np.minimum(1.0, LONGEST / np.maximum(longest, LONGEST)))


def _solved(square: Floats, e: Floats) -> Floats:
    """Return the solutions (k, r) of positive definite equations (k, r, r); of two at once by Cramer's rule.

    The ridge keeps the determinant off zero. A step that rounding spoils leads away, and is asked for again with a
    larger ridge.
    """
    if e.shape[1] != 2:
        return np.asarray(np.linalg.solve(square, e[..., None])[..., 0])
    a, b, c = square[:, 0, 0], square[:, 0, 1], square[:, 1, 1]
    determinant = np.maximum(a * c - b * b, np.finfo(np.float64).tiny)
    x, y = e.T
    return np.stack([c * x - b * y, a * y - b * x], axis=1) / determinant[:, None]
