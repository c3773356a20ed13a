"""The rotation nearest to a matrix, such as one that was typed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats

ANY = 1e-12
"""Sum of two singular values of a matrix of size one below which a turn in their plane costs nothing."""

FEWEST_DECIMALS = 2
"""Decimals from which on entries may be rounded ones."""


@dataclass(frozen=True, eq=False)
class NearestRotation:
    """The rotation nearest to a matrix.

    Attributes
    ----------
    rotation : ndarray, shape (3, 3)
    off : float
        The largest difference of an entry of the matrix from it.
    distance : float
        The square root of the sum of the squared differences.
    only : bool
        Whether there is no other as near: not so for a matrix of rank one, and for some reflections.
    """

    rotation: NDArray[np.float64]
    off: float
    distance: float
    only: bool


def nearest_rotation(R: ArrayLike, where: str = "R") -> NearestRotation:
    """Return the rotation nearest to a 3 x 3 matrix, in the sum of squared differences, and how far it is off.

    With R = U S V^T it is U V^T, with diag(1, 1, -1) between where that would be a reflection. The caller decides what
    counts as near.

    Raises
    ------
    InputError
        Not a 3 x 3 matrix of finite numbers; ``where`` says which.

    References
    ----------
    Kabsch 1976, "A solution for the best rotation to relate two sets of vectors".

    Examples
    --------
    >>> found = nearest_rotation([[0.866, -0.5, 0.0], [0.5, 0.866, 0.0], [0.0, 0.0, 1.0]])
    >>> found.rotation[0].round(6).tolist(), f"{found.off:.0e}"
    ([0.866019, -0.500011, 0.0], '2e-05')
    """
    matrix = as_floats(R, where, "a 3 x 3 matrix of numbers")
    if matrix.shape != (3, 3):
        raise InputError(f"{where}: expected shape (3, 3), got {matrix.shape}")
    if not np.isfinite(matrix).all():
        raise InputError(f"{where}: every entry must be finite")
    size = float(np.abs(matrix).max())
    # Divided by its size: a huge matrix has no finite sum of squares.
    U, stretches, V_T = np.linalg.svd(matrix / (size or 1.0))
    side = math.copysign(1.0, float(np.linalg.det(U) * np.linalg.det(V_T)))
    U[:, 2] *= side
    rotation = np.asarray(U @ V_T)
    difference = matrix - rotation
    only = bool(stretches[1] + side * stretches[2] > ANY)
    return NearestRotation(rotation, float(np.abs(difference).max()), math.hypot(*difference.ravel().tolist()), only)


def is_rounded(R: ArrayLike, found: NearestRotation) -> bool:
    """Return whether a matrix is its nearest rotation with the entries rounded to as many decimals as they have.

    These are at least `FEWEST_DECIMALS`: with fewer, matrices far from any rotation would pass.

    >>> M = [[0.707, -0.707, 0.0], [0.707, 0.707, 0.0], [0.0, 0.0, 1.0]]
    >>> is_rounded(M, nearest_rotation(M))
    True
    """
    exponents = [Decimal(repr(value)).as_tuple().exponent for value in np.ravel(as_floats(R, "R", "numbers")).tolist()]
    decimals = -min(int(exponent) for exponent in exponents)
    return decimals >= FEWEST_DECIMALS and found.off <= 0.5 * 10.0**-decimals
