"""Cylindrical and spherical coordinates of points. Metres and radians; every function takes leading batch dimensions.

In both, ``theta`` is the azimuth: the angle about z from the x axis, positive towards y, in (-pi, pi] (notes 3.13). The
spherical ``phi`` is the angle down from the positive z axis, in [0, pi]. The notes name spherical coordinates without
defining them; this choice keeps theta the same angle in both. Many physics books exchange the two letters.

Where an angle is not defined (the axis for theta, the origin for both) it is 0; equation 3.15 leaves it undefined.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats

Array = NDArray[np.float64]


def cylindrical(p: ArrayLike) -> tuple[Array, Array, Array]:
    """Return r, theta, z of points: distance from the z axis, azimuth, height.

    Parameters
    ----------
    p : array_like, shape (..., 3)
        Cartesian coordinates in metres.

    Returns
    -------
    r, theta, z : ndarray, each of shape (...)
        r >= 0 in metres, theta in (-pi, pi], 0 on the axis; z in metres, which the notes call h.

    Raises
    ------
    InputError
        The last dimension is not 3.

    References
    ----------
    Notes 3.12-3.15.

    Examples
    --------
    >>> [float(value) for value in cylindrical([0.0, 2.0, 0.5])]
    [2.0, 1.5707963267948966, 0.5]
    """
    x, y, z = _components(p)
    return np.hypot(x, y), np.arctan2(y, x), z


def from_cylindrical(r: ArrayLike, theta: ArrayLike, z: ArrayLike) -> Array:
    """Return the points (..., 3) in metres of cylindrical coordinates, which broadcast. Notes 3.9-3.11."""
    r, theta, z = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (r, theta, z)))
    return np.stack([r * np.cos(theta), r * np.sin(theta), z], axis=-1)


def spherical(p: ArrayLike) -> tuple[Array, Array, Array]:
    """Return r, theta, phi of points: distance from the origin, azimuth, angle from the positive z axis.

    Parameters
    ----------
    p : array_like, shape (..., 3)
        Cartesian coordinates in metres.

    Returns
    -------
    r, theta, phi : ndarray, each of shape (...)
        r >= 0 in metres, theta in (-pi, pi], phi in [0, pi]. Theta is 0 on the z axis, both are 0 at the origin.

    Raises
    ------
    InputError
        The last dimension is not 3.

    References
    ----------
    Named in section 3.1 of the notes. phi is atan2(sqrt(x^2 + y^2), z): arccos(z / r) loses half of the digits at
    the poles.

    Examples
    --------
    >>> [float(value) for value in spherical([0.0, 0.0, -2.0])]
    [2.0, 0.0, 3.141592653589793]
    """
    x, y, z = _components(p)
    rho = np.hypot(x, y)
    return np.hypot(rho, z), np.arctan2(y, x), np.arctan2(rho, z)


def from_spherical(r: ArrayLike, theta: ArrayLike, phi: ArrayLike) -> Array:
    """Return the points (..., 3) in metres of spherical coordinates, which broadcast.

    (x, y, z) = (r sin(phi) cos(theta), r sin(phi) sin(theta), r cos(phi)).
    """
    r, theta, phi = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (r, theta, phi)))
    rho = r * np.sin(phi)
    return np.stack([rho * np.cos(theta), rho * np.sin(theta), r * np.cos(phi)], axis=-1)


def _components(p: ArrayLike) -> tuple[Array, Array, Array]:
    """Return x, y, z without negative zeros, for which arctan2 gives -pi, or pi at the origin."""
    points = as_floats(p, "p", "points of shape (..., 3)") + 0.0
    if points.shape[-1:] != (3,):
        raise InputError(f"p: expected shape (..., 3), got {points.shape}")
    return points[..., 0], points[..., 1], points[..., 2]
