"""Axis and angle of a rotation as the notes find them: a frame around the axis, Rodrigues' terms, and both inverses.

They are compared with `armlab.kin.rotations.axis_angle`, which is accurate everywhere and is used elsewhere.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.rotations import skew

Floats = NDArray[np.float64]


def frame_about(axis: ArrayLike) -> Floats:
    """Return C = [n s r], a rotation whose third axis is that of a rotation (notes 3.26-3.27).

    Any n across r will do; this one turns z to r by the shortest way as long as r does not point down.

    Parameters
    ----------
    axis : array_like, shape (3,)
        Need not be of unit length.

    Returns
    -------
    ndarray, shape (3, 3)

    References
    ----------
    Duff et al., *Building an orthonormal basis, revisited*, Journal of Computer Graphics Techniques 6 (2017).
    """
    r = finite_floats(axis, "axis", (3,), "3 finite numbers")
    length = float(np.linalg.norm(r))
    if length == 0.0:
        raise InputError("axis: expected one that is not zero: zero has no direction")
    x, y, z = (r / length).tolist()
    sign = math.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    n = [1.0 + sign * x * x * a, sign * b, -sign * x]
    s = [b, sign + y * y * a, -y]
    return np.column_stack([n, s, [x, y, z]])


def rodrigues_terms(axis: Floats) -> tuple[Floats, Floats, Floats]:
    """Return r r^T, I - r r^T and S(r) of a unit vector (3,): R is the first, plus cos and sin of the others (3.53)."""
    dyad = np.outer(axis, axis)
    return dyad, np.eye(3) - dyad, np.asarray(skew(axis))


def sine_vector(R: Floats) -> Floats:
    """Return 2 sin(theta) r, shape (..., 3), of rotations (..., 3, 3): what is skew in R (notes 3.64)."""
    return np.stack(
        [R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]],
        axis=-1,
    )


def angle_by_arccos(R: Floats) -> Floats:
    """Return the angle in [0, pi] from the trace alone (notes 3.63); near both ends half of the digits are lost."""
    return np.asarray(np.arccos(np.clip(0.5 * (np.trace(R, axis1=-2, axis2=-1) - 1.0), -1.0, 1.0)))


def angle_by_atan2(R: Floats, factor: float = 1.0) -> Floats:
    """Return the angle in [0, pi] from sine and cosine (notes 3.66).

    Parameters
    ----------
    R : ndarray, shape (..., 3, 3)
    factor : float
        Of the root; it is 1, and 1/2 makes the formula that is printed in 3.66.
    """
    root = factor * np.linalg.norm(sine_vector(R), axis=-1)
    return np.asarray(np.arctan2(root, np.trace(R, axis1=-2, axis2=-1) - 1.0))


def eigenvalue_equation(angle: float) -> tuple[float, float, float]:
    """Return the coefficients of the quadratic of the two eigenvalues besides 1 (notes 3.60 has the second sign wrong).

    Examples
    --------
    >>> eigenvalue_equation(0.0)
    (1.0, -2.0, 1.0)
    """
    return 1.0, -2.0 * math.cos(angle), 1.0
