"""Singularity of a Jacobian by every test of the course, and the columns that have become dependent."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong
from armlab.kin.ellipsoid import RANK_TOLERANCE

Array = NDArray[np.float64]

MOST_MINORS = 1000
"""Largest number of minors that are computed; twelve joints and six rows have 924."""

LARGEST_SET = 4
"""Largest number of columns that are tried for dependence."""

PART = 1e-6
"""Coefficient of a dependence, relative to the largest, below which it counts as zero."""


@dataclass(frozen=True, eq=False)
class Minor:
    """The determinant of as many columns as there are rows, or of as many rows as there are columns.

    Attributes
    ----------
    chosen : tuple of int
        The columns, or rows of a tall matrix, 1-based.
    value : float
    """

    chosen: tuple[int, ...]
    value: float


@dataclass(frozen=True, eq=False)
class DeterminantTests:
    """The determinants that vanish at singularities; None where a test does not apply.

    Attributes
    ----------
    determinant : float or None
        det J, square matrices only.
    wide : float or None
        det(J J^T), m <= n.
    tall : float or None
        det(J^T J), m >= n.
    minors : tuple of Minor
        All of them; J has full rank when one is not zero. By Cauchy and Binet their squares add up to the
        determinant above. Empty where there are more than `MOST_MINORS`.
    count : int
        Number of minors.
    sigma_min : float
    """

    determinant: float | None
    wide: float | None
    tall: float | None
    minors: tuple[Minor, ...]
    count: int
    sigma_min: float


def determinant_tests(J: ArrayLike) -> DeterminantTests:
    """Return the determinant tests of a Jacobian, in the units of its rows and columns.

    Zero is what counts: how near a determinant is to zero says nothing about how near a singularity is, because it
    changes with the unit of length (the notes' sections 1.2.1 and 5.1.4 infer it); the smallest singular value does.

    Raises
    ------
    InputError
        Not a matrix.

    References
    ----------
    Notes, section 5.1.4 (for m > n it is det(J^T J), not det(J J^T), which is then always zero) and 5.92-5.98.

    Examples
    --------
    >>> found = determinant_tests([[1.0, 0.0, 2.0], [0.0, 3.0, 0.0]])
    >>> [(minor.chosen, round(minor.value, 12)) for minor in found.minors], round(found.wide, 12)
    ([((1, 2), 3.0), ((1, 3), 0.0), ((2, 3), -6.0)], 45.0)
    """
    matrix = as_floats(J, "J", "numbers of shape (m, n)")
    if matrix.ndim != 2 or 0 in matrix.shape:
        raise InputError(f"J: expected shape (m, n), got {matrix.shape}")
    m, n = matrix.shape
    determinant = float(np.linalg.det(matrix)) if m == n else None
    wide = float(np.linalg.det(matrix @ matrix.T)) if m <= n else None
    tall = float(np.linalg.det(matrix.T @ matrix)) if m >= n else None
    flat = matrix if m <= n else matrix.T
    count = math.comb(flat.shape[1], flat.shape[0])
    minors = _minors(flat) if count <= MOST_MINORS else ()
    sigma_min = float(np.linalg.svd(matrix, compute_uv=False)[-1])
    return DeterminantTests(determinant, wide, tall, minors, count, sigma_min)


def _minors(flat: Array) -> tuple[Minor, ...]:
    m, n = flat.shape
    chosen = list(combinations(range(n), m))
    values = np.linalg.det(np.swapaxes(flat[:, np.array(chosen)], 0, 1)) + 0.0
    return tuple(
        Minor(tuple(k + 1 for k in columns), value) for columns, value in zip(chosen, values.tolist(), strict=True)
    )


@dataclass(frozen=True, eq=False)
class Dependence:
    """Columns of which a sum is zero and no fewer have one.

    Attributes
    ----------
    joints : tuple of int
        1-based.
    factors : ndarray, shape (k,)
        ``sum(factors * columns) == 0``; the largest is 1. A single joint has a column of zeros.
    """

    joints: tuple[int, ...]
    factors: Array


def dependent_columns(J: ArrayLike, usual: ArrayLike | None = None) -> tuple[Dependence, ...]:
    """Return the smallest sets of columns that have become dependent.

    Sets of up to `LARGEST_SET` columns are tried, the smallest first, and no set that holds one already found.
    Where there is none so small, the joints of the first null vector are returned.

    Parameters
    ----------
    J : array_like, shape (m, n)
        Scaled so that its entries can be compared.
    usual : array_like, shape (s, m, n), optional
        The same matrix in other configurations: what is dependent in all of them, too, has not become so here.

    Raises
    ------
    InputError
        Not a matrix of finite numbers.

    References
    ----------
    Notes 5.79-5.83; J_1 + J_3 = 0 alone leaves a matrix of three columns its rank 2, J_2 = 0 is needed, too (the text
    after 5.82).

    Examples
    --------
    >>> [found.joints for found in dependent_columns([[-1.0, 0.0, 1.0], [0.0, 0.0, 0.0]])]
    [(2,), (1, 3)]
    """
    matrix = as_floats(J, "J", "a matrix of numbers")
    if matrix.ndim != 2 or not matrix.size or not np.isfinite(matrix).all():
        raise wrong("J", "a matrix of finite numbers", J)
    others = np.zeros((0, *matrix.shape)) if usual is None else np.asarray(usual, dtype=np.float64)
    floor = _floor(matrix, others)
    found: list[Dependence] = []
    for size in range(1, min(LARGEST_SET, *matrix.shape) + 1):
        for chosen in combinations(range(matrix.shape[1]), size):
            if any(set(known.joints) <= {k + 1 for k in chosen} for known in found):
                continue
            factors = _dependence(matrix[:, chosen], floor)
            if factors is not None and not _always(others[:, :, chosen]):
                found.append(Dependence(tuple(k + 1 for k in chosen), factors))
    return tuple(found) or _of_null_space(matrix, floor)


def independent_sets(J: ArrayLike, usual: ArrayLike, count: int) -> tuple[Dependence, ...]:
    """Return up to ``count`` dependences, none of which follows from the others, as small as they are found.

    Where the small sets of `dependent_columns` are too few, sets of more columns from the null space follow.

    Parameters
    ----------
    J, usual : array_like
        As in `dependent_columns`.
    count : int
    """
    matrix, others = np.asarray(J, dtype=np.float64), np.asarray(usual, dtype=np.float64)
    floor = _floor(matrix, others)
    kept: list[Dependence] = []
    vectors = np.zeros((0, matrix.shape[1]))
    for found in (*dependent_columns(matrix, others), *_by_elimination(matrix, floor)):
        columns = [joint - 1 for joint in found.joints]
        vector = np.zeros(matrix.shape[1])
        vector[columns] = found.factors
        more = np.vstack([vectors, vector / np.linalg.norm(vector)])
        if np.linalg.matrix_rank(more, tol=PART) == len(more) and not _always(others[:, :, columns]):
            kept.append(found)
            vectors = more
    return tuple(kept[:count])


def _floor(matrix: Array, others: Array) -> float:
    """Return the singular value that counts as zero; a matrix that is zero but for rounding has a size elsewhere."""
    sizes = np.linalg.norm(others, 2, axis=(1, 2))
    return RANK_TOLERANCE * float(max(np.linalg.norm(matrix, 2), sizes.max(initial=0.0)))


def _by_elimination(matrix: Array, floor: float) -> tuple[Dependence, ...]:
    """Return a basis of the null space with many zeros: the reduced row echelon form, with the largest pivots."""
    _, sigma, V_T = np.linalg.svd(matrix)
    rows = V_T[int(np.sum(sigma > floor)) :].copy()
    for i in range(len(rows)):
        pivot = int(np.argmax(np.abs(rows[i])))
        rows[i] /= rows[i, pivot]
        for k in range(len(rows)):
            if k != i:
                rows[k] -= rows[k, pivot] * rows[i]
    found = []
    for row in rows:
        vector = row / row[int(np.argmax(np.abs(row)))]
        kept = [k for k in range(len(vector)) if abs(vector[k]) > PART]
        found.append(Dependence(tuple(k + 1 for k in kept), vector[kept]))
    return tuple(sorted(found, key=lambda each: len(each.joints)))


def _dependence(columns: Array, floor: float) -> Array | None:
    """Return the coefficients of a vanishing sum, none of them small; None when there is none."""
    _, sigma, V_T = np.linalg.svd(columns)
    if sigma[-1] > floor:
        return None
    factors = V_T[-1] / V_T[-1][int(np.argmax(np.abs(V_T[-1])))]
    return np.asarray(factors) if np.all(np.abs(factors) > PART) else None


def _always(usual: Array) -> bool:
    """Return whether columns are dependent in every configuration."""
    if not len(usual):
        return False
    sigma = np.linalg.svd(usual, compute_uv=False)
    return bool(np.all(sigma[:, -1] <= RANK_TOLERANCE * np.maximum(sigma[:, 0], 1.0)))


def _of_null_space(matrix: Array, floor: float) -> tuple[Dependence, ...]:
    _, sigma, V_T = np.linalg.svd(matrix)
    rank = int(np.sum(sigma > floor))
    if rank == matrix.shape[1]:
        return ()
    vector = V_T[rank] / V_T[rank][int(np.argmax(np.abs(V_T[rank])))]
    kept = [k for k in range(len(vector)) if abs(vector[k]) > PART]
    return (Dependence(tuple(k + 1 for k in kept), vector[kept]),)
