"""The quaternion of a rotation by roots and signs, as the notes find it, to be compared with what the lab uses.

`armlab.kin.rotations.quaternion_from_rotation` divides by the largest component, and is right everywhere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import finite_floats

Floats = NDArray[np.float64]


def quaternion_by_signs(R: ArrayLike, slip: bool = False) -> Floats:
    """Return (eta, eps) of a rotation from the roots of its diagonal and the signs of three differences, shape (4,).

    At half a turn all differences are zero, and so are the signs: what is found is then no unit quaternion. Near it
    the signs are those of rounding errors.

    Parameters
    ----------
    R : array_like, shape (3, 3)
    slip : bool
        Whether the sign of eps_y is that of R13 - R32, as 3.78 is printed, and not of R13 - R31.

    References
    ----------
    Notes 3.76-3.79.

    Examples
    --------
    >>> quaternion_by_signs([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).round(6).tolist()
    [0.707107, 0.0, 0.0, 0.707107]
    """
    m = finite_floats(R, "R", (3, 3), "3 rows of 3 finite numbers")
    a, b, c = m.diagonal().tolist()
    squares = np.array([1.0 + a + b + c, 1.0 + a - b - c, 1.0 - a + b - c, 1.0 - a - b + c])
    other = m[2, 1] if slip else m[2, 0]
    signs = np.sign([1.0, m[2, 1] - m[1, 2], m[0, 2] - other, m[1, 0] - m[0, 1]])
    return np.asarray(0.5 * signs * np.sqrt(np.maximum(squares, 0.0)))


def matrix_of_quaternion(q: ArrayLike) -> Floats:
    """Return the matrix of 3.73 of any four numbers, (3, 3), without making them of unit length first."""
    w, x, y, z = finite_floats(q, "q", (4,), "4 finite numbers").tolist()
    return np.array(
        [
            [2.0 * (w * w + x * x) - 1.0, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 2.0 * (w * w + y * y) - 1.0, 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 2.0 * (w * w + z * z) - 1.0],
        ]
    )
