"""The quaternion of a rotation matrix by signs, as the notes have it, and the matrix of a quaternion of any length."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.rotations import skew

Floats = NDArray[np.float64]


def by_signs(R: Floats, other: tuple[int, int] = (2, 0)) -> Floats:
    """Return the quaternion of 3.76 to 3.79.

    Parameters
    ----------
    R : ndarray, shape (3, 3)
    other : (int, int)
        Row and column, from 0, of the entry that is subtracted in the sign of 3.78. It is (2, 0); printed is (2, 1).

    Returns
    -------
    ndarray, shape (4,)
        Scalar first. At half a turn all signs are 0, and so are its components: it is of no use there.

    References
    ----------
    Notes 3.76-3.79.
    """
    d = np.diag(R)
    roots = np.sqrt(np.maximum([d.sum() + 1.0, *(2.0 * d - d.sum() + 1.0)], 0.0)) / 2.0
    signs = np.sign([1.0, R[2, 1] - R[1, 2], R[0, 2] - R[other], R[1, 0] - R[0, 1]])
    return np.asarray(roots * signs)


def matrix_of(q: Floats) -> Floats:
    """Return the matrix of a quaternion by the formula for unit length, which is not asked for: shape (3, 3).

    References
    ----------
    Notes 3.72.
    """
    w, v = q[0], q[1:]
    return np.asarray((2.0 * w * w - 1.0) * np.eye(3) + 2.0 * np.outer(v, v) + 2.0 * w * np.asarray(skew(v)))
