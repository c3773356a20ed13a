"""Parts of a matrix: symmetric and skew-symmetric ones, and dyads (outer products)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import finite_floats

Floats = NDArray[np.float64]


def symmetric_part(A: ArrayLike) -> Floats:
    """Return (A + A^T)/2 of a matrix (3, 3). Notes 3.38."""
    matrix = _matrix(A)
    return 0.5 * (matrix + matrix.T)


def skew_part(A: ArrayLike) -> Floats:
    """Return (A - A^T)/2 of a matrix (3, 3). Notes 3.38."""
    matrix = _matrix(A)
    return 0.5 * (matrix - matrix.T)


def skew_vector(A: ArrayLike) -> Floats:
    """Return v with S(v) = (A - A^T)/2, shape (3,): the inverse of `armlab.kin.rotations.skew` for a skew matrix.

    Examples
    --------
    >>> skew_vector([[0, -3, 2], [3, 0, -1], [-2, 1, 0]]).tolist()
    [1.0, 2.0, 3.0]
    """
    S = skew_part(A)
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def quadratic_form(A: ArrayLike, x: ArrayLike) -> float:
    """Return x^T A x, a number: only the symmetric part of A counts (notes 3.40-3.41, where 3.41 prints a vector)."""
    vector = finite_floats(x, "x", (3,), "3 finite numbers")
    return float(vector @ _matrix(A) @ vector)


def dyads(B: ArrayLike) -> Floats:
    """Return b_i b_j^T of the columns of B, shape (3, 3, 3, 3): the first two places are i and j.

    With coefficients a_ij their sum is B A B^T (notes 3.34). With those of the identity it is B B^T, and not B^T B as
    3.35 is printed: dyads of different columns are missing because the identity has zeros beside its diagonal, though
    none of them is zero.

    Examples
    --------
    >>> dyads(np.eye(3))[0, 2].tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    """
    columns = _matrix(B).T
    return np.asarray(columns[:, None, :, None] * columns[None, :, None, :])


def expansion(A: ArrayLike, B: ArrayLike) -> Floats:
    """Return the sum of all a_ij b_i b_j^T, (3, 3), term by term; it is B A B^T (notes 3.34)."""
    return np.asarray(np.einsum("ij,ijkl->kl", _matrix(A), dyads(B)))


def _matrix(values: ArrayLike) -> Floats:
    return finite_floats(values, "A", (3, 3), "3 rows of 3 finite numbers")
