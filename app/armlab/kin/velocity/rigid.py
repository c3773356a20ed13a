"""Velocities of a rigid body: one point and one angular velocity give all the others.

A twist is ``(v; omega)``, the velocity of one point in m/s and the angular velocity in rad/s, both in the same axes.
The angular velocity belongs to the body, the linear one to the point. Every function takes leading batch dimensions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong
from armlab.kin.rotations import rotation_from_axis_angle, skew

Floats = NDArray[np.float64]


def point_velocity(v: ArrayLike, omega: ArrayLike, r: ArrayLike) -> Floats:
    """Return the velocity of a second point of a body: ``v2 = v1 + omega x r12``.

    Parameters
    ----------
    v : array_like, shape (..., 3)
        Velocity of the first point, m/s.
    omega : array_like, shape (..., 3)
        Angular velocity of the body, rad/s.
    r : array_like, shape (..., 3)
        Vector from the first point to the second, metres, in the same axes.

    Returns
    -------
    ndarray, shape (..., 3)

    References
    ----------
    Notes 1.8 and 5.9. That all pairs of points have the same omega follows only with a third point off the line of the
    first two: the printed 5.8 fixes no more than the part across r23.

    Examples
    --------
    >>> point_velocity([1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, 0.0]).tolist()
    [-1.0, 0.0, 0.0]
    """
    first, turning, lever = _vectors(v, "v"), _vectors(omega, "omega"), _vectors(r, "r")
    return np.asarray(first + np.cross(turning, lever))


def twist_at(twist: ArrayLike, r: ArrayLike) -> Floats:
    """Return the twist of the same body at another point.

    Parameters
    ----------
    twist : array_like, shape (..., 6)
        ``(v; omega)`` at the first point.
    r : array_like, shape (..., 3)
        Vector from the first point to the second, metres, in the same axes.

    Returns
    -------
    ndarray, shape (..., 6)
        The angular velocity is the same.

    References
    ----------
    Notes 5.9.
    """
    given = as_floats(twist, "twist", "numbers of shape (..., 6)")
    if given.shape[-1:] != (6,):
        raise InputError(f"twist: expected shape (..., 6), got {given.shape}")
    v = point_velocity(given[..., :3], given[..., 3:], r)
    return np.concatenate([v, np.broadcast_to(given[..., 3:], v.shape)], axis=-1)


def rotation_rate(R: ArrayLike, omega: ArrayLike) -> Floats:
    """Return how a rotation changes: ``Rdot = S(omega) R``, shape (..., 3, 3), 1/s.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Orientation of the body in the fixed axes.
    omega : array_like, shape (..., 3)
        Angular velocity in the fixed axes, rad/s.

    References
    ----------
    Notes 5.40.
    """
    return np.asarray(skew(_vectors(omega, "omega")) @ _matrices(R, "R"))


def angular_velocity(R: ArrayLike, Rdot: ArrayLike) -> Floats:
    """Return omega (..., 3) of ``S(omega) = Rdot R^T``, in the fixed axes, rad/s.

    Only the skew part of ``Rdot R^T`` is used. The rest is zero for the derivative of a rotation, and small for numeric
    derivatives.

    Parameters
    ----------
    R, Rdot : array_like, shape (..., 3, 3)

    References
    ----------
    Notes 5.41.
    """
    S = _matrices(Rdot, "Rdot") @ np.swapaxes(_matrices(R, "R"), -1, -2)
    twice = [S[..., 2, 1] - S[..., 1, 2], S[..., 0, 2] - S[..., 2, 0], S[..., 1, 0] - S[..., 0, 1]]
    return 0.5 * np.stack(twice, axis=-1)


def turned_by(rates: ArrayLike, durations: ArrayLike) -> Floats:
    """Return the rotation at the end of pieces of constant angular velocity, starting from the identity.

    The integral of omega is only ``sum(durations * rates)``: it does not know the order of the pieces, the rotation
    does.

    Parameters
    ----------
    rates : array_like, shape (k, 3)
        Angular velocity of each piece in the fixed axes, rad/s.
    durations : array_like, shape (..., k)
        Seconds, none negative.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    References
    ----------
    Notes 5.19-5.21.

    Examples
    --------
    >>> quarter = np.pi / 2
    >>> z_then_x = turned_by([[0, 0, quarter], [quarter, 0, 0]], [1, 1])
    >>> x_then_z = turned_by([[quarter, 0, 0], [0, 0, quarter]], [1, 1])
    >>> bool(np.allclose(z_then_x, x_then_z))
    False
    """
    omegas = np.atleast_2d(_vectors(np.asarray(rates, dtype=float), "rates"))
    seconds = as_floats(durations, "durations", f"{len(omegas)} numbers")
    if seconds.shape[-1:] != (len(omegas),) or not (seconds >= 0.0).all() or not np.isfinite(seconds).all():
        raise wrong("durations", f"{len(omegas)} numbers of seconds, none negative", durations)
    R = np.broadcast_to(np.eye(3), (*seconds.shape[:-1], 3, 3))
    for k, omega in enumerate(omegas):
        angles = float(np.linalg.norm(omega)) * seconds[..., k]
        if angles.any():
            # About axes that stay: later turns stand before the others.
            R = np.asarray(rotation_from_axis_angle(omega, angles)) @ R
    return np.array(R)


def _vectors(values: ArrayLike, where: str) -> Floats:
    found = as_floats(values, where, "numbers of shape (..., 3)")
    if found.shape[-1:] != (3,):
        raise InputError(f"{where}: expected shape (..., 3), got {found.shape}")
    return found


def _matrices(values: ArrayLike, where: str) -> Floats:
    found = as_floats(values, where, "numbers of shape (..., 3, 3)")
    if found.shape[-2:] != (3, 3):
        raise InputError(f"{where}: expected shape (..., 3, 3), got {found.shape}")
    return found
