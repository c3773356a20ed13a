"""Orientation errors and their Jacobians, for many configurations at once, in axes of frame 0.

The error of an orientation R with respect to a wanted R_d is theta r with R_d R^T = rot(r, theta). With omega the
angular velocity of R the time derivative of theta^2 / 2 is exactly -theta r . omega, so that J^T e is the exact
downhill slope of half the squared error: fixed-step gradients and Lyapunov functions are what they claim to be.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.euler import euler_angles
from armlab.kin.ik.iterate.task_vector import wrapped_angle
from armlab.kin.rotations import axis_angle, rotation_about

Floats = NDArray[np.float64]

HALF_TURN_SINE = 1e-6
"""Sine below which, near half a turn, the axis is not read from the skew part of a rotation, which vanishes there."""

REPRESENTED = 1e-7
"""Determinant of the Euler rates (sine or cosine of the middle angle) below which the angles are singular."""


def rotation_vector(R: Floats) -> Floats:
    """Return theta r (..., 3), angle times axis, of rotations (..., 3, 3), with theta in [0, pi]."""
    skewed = np.stack([R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]], axis=-1)
    sine = 0.5 * np.sqrt(np.sum(skewed * skewed, axis=-1))
    cosine = 0.5 * (np.trace(R, axis1=-2, axis2=-1) - 1.0)
    angle = np.arctan2(sine, cosine)
    # theta / (2 sin theta), which is 1/2 at the identity.
    small = sine < 1e-12
    found = np.asarray(np.where(small, 0.5, 0.5 * angle / np.where(small, 1.0, sine))[..., None] * skewed)
    opposite = (sine < HALF_TURN_SINE) & (cosine < 0.0)
    if np.any(opposite):
        axes, angles = axis_angle(R[opposite])
        found[opposite] = axes * angles[..., None]
    return found


def turn_about_z(R: Floats) -> Floats:
    """Return the angle about z (...) of the rotation about z that comes closest to rotations (..., 3, 3)."""
    return np.asarray(np.arctan2(R[..., 1, 0] - R[..., 0, 1], R[..., 0, 0] + R[..., 1, 1]))


def approach_error(R: Floats, wanted: Floats) -> Floats:
    """Return theta r of the turn (..., 3 x 3 each) that brings the tool's z axis to the wanted one, in the tool's x, y.

    The turn has no component along the tool's z, so two components (..., 2) say all.
    """
    z, goal = R[..., :, 2], wanted[..., :, 2]
    axis = np.cross(z, goal)
    sine, cosine = np.linalg.norm(axis, axis=-1), np.sum(z * goal, axis=-1)
    small = sine < 1e-12
    turn = axis * np.where(small, 1.0, np.arctan2(sine, cosine) / np.where(small, 1.0, sine))[..., None]
    # Opposite directions have no unique turn between them; half a turn about the tool's x is one.
    turn = np.where((small & (cosine < 0.0))[..., None], math.pi * R[..., :, 0], turn)
    return np.asarray(np.einsum("...ji,...j->...i", R[..., :, :2], turn))


def euler_error(R: Floats, wanted: Floats, axes: str, fixed: bool) -> tuple[Floats, Floats]:
    """Return differences of Euler angles (..., 3) in [-pi, pi), and the present angles (..., 3).

    The triple of the present orientation is the one of two that is nearer to the wanted, principal triple.
    """
    goal = euler_angles(wanted, axes, fixed=fixed).solutions[..., 0, :]
    both = euler_angles(R, axes, fixed=fixed).solutions
    differences = wrapped_angle(goal[..., None, :] - both)
    nearer = np.argmin(np.sum(differences**2, axis=-1), axis=-1)[..., None, None]
    return np.take_along_axis(differences, nearer, -2)[..., 0, :], np.take_along_axis(both, nearer, -2)[..., 0, :]


def euler_rates(angles: Floats, axes: str, fixed: bool) -> Floats:
    """Return the matrix E (..., 3, 3) with omega = E d(angles)/dt, columns in the order of the sequence.

    Each column is the axis its angle turns about: the axes of earlier turns carry those of later ones when they move,
    and the other way round when they are fixed.
    """
    columns = [np.zeros(3)] * 3
    carried = np.broadcast_to(np.eye(3), (*angles.shape[:-1], 3, 3))
    for k in reversed(range(3)) if fixed else range(3):
        columns[k] = carried[..., :, "xyz".index(axes[k])]
        carried = carried @ rotation_about(axes[k], angles[..., k])
    return np.stack(columns, axis=-1)


def analytic_rows(E: Floats, omega: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Return E^-1 J_omega (..., 3, n) and where E is invertible; elsewhere the rows are zero."""
    regular = np.abs(np.linalg.det(E)) > REPRESENTED
    safe = np.where(regular[..., None, None], E, np.eye(3))
    return np.where(regular[..., None, None], np.linalg.solve(safe, omega), 0.0), regular
