"""The matrix exponential e^(A t) in three ways: by its series, by eigenvectors, and by SciPy.

It solves xdot = A x: x(t) = e^(A t) x(0) (notes 1.50-1.58).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats, whole_number, wrong

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Basis = Literal["good", "poor", "none"]

MOST_ROWS = 12
MOST_TERMS = 400

LARGEST = 300.0
"""Largest real part of an eigenvalue times t: beyond about 700 the exponential is no floating-point number."""

LARGEST_SIZE = 1e9
"""Largest sum of the moduli in a column of A t: beyond it the rounding of A t alone changes the seventh digit of the
result, even where everything decays."""

LARGEST_LOGARITHM = 700.0
"""Largest natural logarithm of a term of the series."""

POOR, NONE = 1e3, 1e7
"""Condition numbers of T: above the first a noticeable number of digits is lost; from the second on there is no basis
of eigenvectors. A double eigenvalue with one eigenvector is found as two that are sqrt(2e-16) = 1.5e-8 apart, with a
condition of about the inverse of that."""

DOUBLE = 1e-7
"""Distance, relative to the size of A, below which two eigenvalues without a basis of eigenvectors are one if their
eigenvectors agree, too. Rounding splits a double eigenvalue by 1.5e-8, into two real or two complex ones."""


@dataclass(frozen=True, eq=False)
class Diagonalisation:
    """A = T diag(values) T^-1, where there is such a T.

    Attributes
    ----------
    values : ndarray of complex, shape (n,)
        Eigenvalues, 1/s. A double one with a single eigenvector is there twice, exactly, and so is its eigenvector.
    T : ndarray of complex, shape (n, n)
        Columns: unit eigenvectors.
    condition : float
        Largest over smallest singular value of T; infinite where T has no inverse.
    basis : "good", "poor" or "none"
        The quality of T, by the limits `POOR` and `NONE`.
    """

    values: Complex
    T: Complex
    condition: float
    basis: Basis

    @property
    def real(self) -> bool:
        """Whether all eigenvalues are real."""
        return not bool(self.values.imag.any())

    @property
    def says(self) -> str:
        """A sentence on T: whether it exists, and how well it is conditioned."""
        if self.basis == "none":
            return (
                "A is not diagonalisable within rounding: it has too few independent eigenvectors, T has no inverse; "
                "the series and SciPy do not need it"
            )
        if self.basis == "poor":
            lost = round(math.log10(self.condition))
            return f"the eigenvectors are almost parallel: about {lost} of 16 digits are lost"
        return "the eigenvectors are a good basis"


def by_scipy(A: ArrayLike, t: ArrayLike = 1.0) -> Array:
    """Return e^(A t) by `scipy.linalg.expm`, for times of any shape.

    It works for every matrix. Where eigenvectors are a good basis they may be a digit or two more exact: of random
    matrices up to 4 x 4 it was right to 1e-11 of the largest entry, or better.

    Parameters
    ----------
    A : array_like, shape (n, n)
        1/s where t is in seconds.
    t : array_like, shape (...)

    Returns
    -------
    ndarray, shape (..., n, n)

    Raises
    ------
    InputError
        Not a square matrix of at most `MOST_ROWS` rows, not finite, or so large that the result may be no number: an
        eigenvalue whose real part times t is above `LARGEST`, or moduli above `LARGEST_SIZE`. A decaying exponential is
        not too large.

    References
    ----------
    Al-Mohy and Higham, *A new scaling and squaring algorithm for the matrix exponential*, 2009.
    """
    from scipy.linalg import expm  # type: ignore[import-untyped]

    matrix, times = _checked(A, t)
    return np.asarray(expm(matrix * times[..., None, None]), dtype=np.float64)


def partial_sums(A: ArrayLike, t: float, terms: int) -> Array:
    """Return the sums of the first 1, 2, ... terms of the series of e^(A t), shape (terms, n, n). Notes 1.50.

    The first term is the identity. While k is below the size of A t terms grow before they fall; where they have both
    signs, rounding leaves an error of about 1e-16 times the largest of them.

    Raises
    ------
    InputError
        As of `by_scipy`, not 1 to `MOST_TERMS` terms, or a term that is no number any more.
    """
    matrix, times = _checked(A, finite_floats(t, "t", (), "one number"))
    count = whole_number(terms, "terms", 1)
    if count > MOST_TERMS:
        raise wrong("terms", f"at most {MOST_TERMS}", terms)
    scaled = matrix * times
    if _logarithm_of_largest_term(_size(scaled), count) > LARGEST_LOGARITHM:
        raise InputError(
            f"A t: terms of the series are too large for {count} of them, with column sums of moduli up to "
            f"{_size(scaled):.4g}; take fewer terms or a smaller t"
        )
    sums = np.empty((count, *scaled.shape))
    term = np.eye(len(scaled))
    total = np.zeros_like(term)
    for k in range(count):
        total = total + term
        sums[k] = total
        term = term @ scaled / (k + 1)
    return sums


def remainder_bound(A: ArrayLike, t: float, terms: int) -> float:
    """Return a bound of every entry of the remainder after so many terms; infinite where none is known yet.

    The terms that are left out are a geometric series at most: with x the largest sum of moduli in a column of A t,
    it is x^N / N! / (1 - x/(N+1)) for N terms, where N + 1 > x. Rounding is not in it.
    """
    return float(remainder_bounds(A, t, terms)[-1])


def remainder_bounds(A: ArrayLike, t: float, terms: int) -> Array:
    """Return the bounds after 1, 2, ... terms, shape (terms,); see `remainder_bound`."""
    matrix, times = _checked(A, finite_floats(t, "t", (), "one number"))
    x = _size(matrix * times)
    return np.array([_bound(x, count) for count in range(1, whole_number(terms, "terms", 1) + 1)])


def _bound(x: float, count: int) -> float:
    if x == 0.0:
        return 0.0
    if count + 1 <= x:
        return math.inf
    logarithm = count * math.log(x) - math.lgamma(count + 1)
    return math.exp(logarithm) / (1.0 - x / (count + 1)) if logarithm <= LARGEST_LOGARITHM else math.inf


def _logarithm_of_largest_term(x: float, terms: int) -> float:
    """Return the logarithm of the largest x^k / k! with k up to ``terms``; the terms grow up to k = x."""
    k = min(terms, math.floor(x))
    return k * math.log(x) - math.lgamma(k + 1) if k else 0.0


def diagonalised(A: ArrayLike) -> Diagonalisation:
    """Return eigenvalues and eigenvectors, and whether these are a basis. Notes 1.57.

    Raises
    ------
    InputError
        As of `by_scipy`.
    """
    matrix, _ = _checked(A, 0.0)
    values, T = map(np.asarray, np.linalg.eig(matrix))
    sigma = np.linalg.svd(T, compute_uv=False)
    condition = float(sigma[0] / sigma[-1]) if sigma[-1] > 0.0 else math.inf
    basis: Basis = "none" if condition >= NONE else "poor" if condition >= POOR else "good"
    values, T = values.astype(np.complex128), T.astype(np.complex128)
    if basis == "none":
        values, T = _doubled(matrix, values, T)
    return Diagonalisation(values, T, condition, basis)


def _doubled(matrix: Array, values: Complex, T: Complex) -> tuple[Complex, Complex]:
    """Return eigenvalues and eigenvectors, with pairs merged that only rounding has separated.

    The mean of such a pair is right to rounding, although each is only half as many digits.
    """
    values, T = values.copy(), T.copy()
    near = DOUBLE * _size(matrix)
    left = list(range(len(values)))
    while left:
        i = left.pop(0)
        j = min(left, key=lambda k: abs(values[k] - values[i]), default=i)
        parallel = abs(np.vdot(T[:, i], T[:, j])) >= 1.0 - DOUBLE
        if j == i or abs(values[j] - values[i]) > near or not parallel:
            continue
        left.remove(j)
        mean = 0.5 * (values[i] + values[j])
        if abs(mean.imag) <= near:
            mean = mean.real
        _, _, V_H = np.linalg.svd(matrix - mean * np.eye(len(matrix)))
        values[[i, j]] = mean
        T[:, [i, j]] = V_H[-1].conj()[:, None]
    return values, T


def by_eigenvectors(A: ArrayLike, t: float = 1.0) -> Array | None:
    """Return e^(A t) = T e^(Lambda t) T^-1, shape (n, n), or None where the eigenvectors are no basis.

    Notes 1.58 print T^-1 e^(Lambda t) T, which contradicts A = T Lambda T^-1 (1.57); see `as_printed`.

    Raises
    ------
    InputError
        As of `by_scipy`.

    Examples
    --------
    >>> by_eigenvectors([[0.0, 1.0], [-2.0, -3.0]], 0.7).round(4).tolist()
    [[0.7466, 0.25], [-0.5, -0.0034]]
    >>> by_eigenvectors([[-1.0, 1.0], [0.0, -1.0]]) is None
    True
    """
    matrix, times = _checked(A, finite_floats(t, "t", (), "one number"))
    found = diagonalised(matrix)
    if found.basis == "none":
        return None
    # With pairs of conjugate eigenvalues the product is real but for rounding.
    return np.asarray((found.T @ np.diag(np.exp(found.values * times)) @ np.linalg.inv(found.T)).real)


def as_printed(A: ArrayLike, t: float = 1.0) -> Complex | None:
    """Return T^-1 e^(Lambda t) T, which notes 1.58 print, to show that it is another matrix; None as above.

    Eigenvectors have unit length here; with other lengths the printed product would be yet another one. It may be
    complex.
    """
    matrix, times = _checked(A, finite_floats(t, "t", (), "one number"))
    found = diagonalised(matrix)
    if found.basis == "none":
        return None
    return np.asarray(np.linalg.inv(found.T) @ np.diag(np.exp(found.values * times)) @ found.T)


def flow(A: ArrayLike, x0: ArrayLike, t: ArrayLike) -> Array:
    """Return x(t) = e^(A t) x0 at times of any shape, shape (..., n). Notes 1.52.

    Raises
    ------
    InputError
        As of `by_scipy`, or a start that does not fit.
    """
    matrix, times = _checked(A, t)
    start = finite_floats(x0, "x0", (len(matrix),), f"{len(matrix)} finite numbers")
    return np.asarray(by_scipy(matrix, times) @ start)


def largest_difference(one: ArrayLike, other: ArrayLike) -> float:
    """Return the largest modulus among the differences of two matrices."""
    return float(np.abs(np.asarray(one) - np.asarray(other)).max())


def _checked(A: ArrayLike, t: ArrayLike) -> tuple[Array, Array]:
    matrix = as_floats(A, "A", "a square matrix")
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not 1 <= len(matrix) <= MOST_ROWS:
        raise InputError(f"A: expected a square matrix of 1 to {MOST_ROWS} rows, got shape {matrix.shape}")
    times = as_floats(t, "t", "numbers")
    if not (np.isfinite(matrix).all() and np.isfinite(times).all()):
        raise InputError("A t: expected finite numbers")
    with np.errstate(over="ignore"):
        size = _size(matrix) * float(np.abs(times).max(initial=0.0))
    if size > LARGEST_SIZE:
        raise InputError(
            f"A t: expected column sums of moduli up to {LARGEST_SIZE:g}, got {size:.4g}: A t is too large for e^(A t) "
            "to have right digits"
        )
    grown = float(np.multiply.outer(np.linalg.eigvals(matrix).real, times).max(initial=0.0))
    if grown > LARGEST:
        raise InputError(
            f"A t: expected real parts of eigenvalues up to {LARGEST:g}, got {grown:.4g}: e^(A t) is too large"
        )
    return matrix, times


def _size(matrix: Array) -> float:
    """Return the largest sum of moduli in a column (the 1-norm), which bounds every entry of every power."""
    return float(np.abs(matrix).sum(axis=0).max())
