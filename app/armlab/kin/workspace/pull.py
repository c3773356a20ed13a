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

    def residual(values: Floats, rows: NDArray[np.intp]) -> Floats:
        left = np.asarray(targets[rows] - joint.place(joint.arm.position(values)))
        return left if weights is None else np.asarray(left * weights[rows])

    def rates(values: Floats, rows: NDArray[np.intp]) -> Floats:
        found = section_rates(joint, joint.arm.jacobian(values))
        return found if weights is None else np.asarray(found * weights[rows][:, :, None])

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


def section_rates(joint: FirstJoint, jacobians: NDArray[np.floating]) -> Floats:
    """Return d(u, v)/dq, shape (k, 2, n), in metres per radian or metre, from Jacobians (k, 6, n)."""
    J = np.asarray(jacobians[:, :3, :], dtype=np.float64)
    if not joint.revolute:
        return np.asarray(joint.axes[:, :2].T @ J)
    # Joint 1 carries a point across, by as much as it is away from the axis; a quarter turn back lies outward.
    first, second, along = joint.axes.T
    outward = J[:, :, 0] @ (np.outer(second, first) - np.outer(first, second))
    away = lengths(outward)[:, None]
    outward = np.divide(outward, away, out=np.broadcast_to(first, outward.shape).copy(), where=away > 0.0)
    rates = np.empty((len(J), 2, J.shape[2]))
    np.einsum("ka,kan->kn", outward, J, out=rates[:, 0])
    np.einsum("a,kan->kn", along, J, out=rates[:, 1])
    return rates


def lengths(vectors: Floats) -> Floats:
    """Return the lengths of vectors (k, r), in half the time of `numpy.linalg.norm`."""
    return np.asarray(np.sqrt(np.einsum("kr,kr->k", vectors, vectors)))


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
    error = lengths(e)
    damping = np.full(len(q), FIRST_DAMPING)
    moving = _columns(joints)
    low, high = joint.arm.limits[moving].T
    scale = np.where(joint.arm.revolute[moving], 1.0, joint.arm.length_scale)
    # A step that led away leaves its configuration, whose rates are known: as many are refused as are taken.
    known, moved = np.empty((len(q), e.shape[1], len(joints))), np.ones(len(q), dtype=bool)
    for _ in range(iterations if joints else 0):
        rows = np.flatnonzero((error > tolerance) & (damping < MOST_DAMPING))
        if not rows.size:
            break
        new = rows[moved[rows]]
        if new.size:
            known[new] = rates(q[new], new)[..., moving] * scale
        J = known[rows]
        trial = q[rows]
        here = trial[:, moving]
        step = _step(J, e[rows], damping[rows], here <= low, here >= high) * scale
        trial[:, moving] = np.minimum(np.maximum(here + step, low), high)
        left = residual(trial, rows)
        length = lengths(left)
        nearer = length < error[rows]
        taken = rows[nearer]
        q[taken], e[taken], error[taken], moved[rows] = trial[nearer], left[nearer], length[nearer], nearer
        damping[rows] = np.where(nearer, np.maximum(damping[rows] * EASIER, LEAST_DAMPING), damping[rows] * HARDER)
    return q, error


def _columns(joints: tuple[int, ...]) -> slice | list[int]:
    """Return the columns of joints: as a slice, which copies nothing, where none is left out between them."""
    together = joints and joints == tuple(range(joints[0], joints[-1] + 1))
    return slice(joints[0], joints[-1] + 1) if together else list(joints)


def _step(J: Floats, e: Floats, damping: Floats, at_low: NDArray[np.bool_], at_high: NDArray[np.bool_]) -> Floats:
    """Return damped steps (k, m), solved again without the joints that would be pushed through a limit."""
    mean_square = np.einsum("kij,kij->k", J, J) / J.shape[1]
    ridge = damping * mean_square + np.finfo(np.float64).tiny ** 0.5
    step = np.einsum("kij,ki->kj", J, _solved(J, ridge, e))
    outward = (at_low & (step < 0.0)) | (at_high & (step > 0.0))
    if outward.any():
        held = np.where(outward[:, None, :], 0.0, J)
        step = np.einsum("kij,ki->kj", held, _solved(held, ridge, e))
        step[(at_low & (step < 0.0)) | (at_high & (step > 0.0))] = 0.0
    size = np.abs(step)
    if size.max(initial=0.0) > LONGEST:
        step *= LONGEST / np.maximum(size.max(axis=1, keepdims=True), LONGEST)
    return np.asarray(step)


def _solved(J: Floats, ridge: Floats, e: Floats) -> Floats:
    """Return the solutions (k, r) of (J Jᵀ + ridge) x = e; of two equations at once by Cramer's rule.

    The ridge keeps the determinant off zero. A step that rounding spoils leads away, and is asked for again with a
    larger ridge.
    """
    r = e.shape[1]
    if r != 2:
        square = J @ J.transpose(0, 2, 1) + ridge[:, None, None] * np.eye(r)
        return np.asarray(np.linalg.solve(square, e[..., None])[..., 0])
    u, v = J[:, 0], J[:, 1]
    a, b, c = np.einsum("km,km->k", u, u) + ridge, np.einsum("km,km->k", u, v), np.einsum("km,km->k", v, v) + ridge
    determinant = np.maximum(a * c - b * b, np.finfo(np.float64).tiny)
    found = np.empty((len(e), 2))
    found[:, 0] = (c * e[:, 0] - b * e[:, 1]) / determinant
    found[:, 1] = (a * e[:, 1] - b * e[:, 0]) / determinant
    return found
