"""Common roots of six equations that are trilinear in the (1, cos, sin) of three angles, by eigenvalues.

One angle is hidden in the coefficients. With x = tan(./2) of the other two the equations are polynomials in the nine
monomials x_u^i x_v^j, i, j <= 2; together with their multiples by x_u they are 12 equations in 12 monomials. The hidden
angle is ``phi + 2 atan x``, which makes their matrix A x^2 + B x + C. It is singular at the roots: a quadratic
eigenvalue problem of size 12, whose 24 eigenvalues are the 16 roots and, from the factor (1 + x^2)^4, i and -i.
The eigenvector holds the monomials, and with them the other two angles.

References
----------
Manocha and Canny, "Efficient inverse kinematics for general 6R manipulators", 1994, for eigenvalues instead of a
polynomial of degree 16; the choice of phi here stands for their change of variable.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_loop import Complex, Floats

FARTHEST = 1e-8
"""Smallest |exp(i t)|: roots below it, or above its inverse, are spurious or practically at infinity."""

PHASES = 0.3 + np.pi / 3.0 * np.arange(6)
"""Values of phi to choose from: half a turn away, where x is infinite, there should be no root."""

_HALF = np.array([[1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 2.0, 0.0]])
_MONOMIALS = np.kron(_HALF, _HALF)
"""Coefficients of (1, c, s), times 1 + x^2, as polynomials in x = tan(./2), for one angle and for two."""


def matrices(middle: Floats, hidden: int) -> Floats:
    """Return the 12 x 12 matrices M with M_0 + M_1 cos + M_2 sin singular at a root of the hidden angle.

    Parameters
    ----------
    middle : ndarray, shape (B, 6, 3, 3, 3)
        Coefficients of the equations over (1, c, s) of three angles.
    hidden : 0, 1 or 2

    Returns
    -------
    ndarray, shape (3, B, 12, 12)
        With rows of length one over all three.
    """
    moved = np.moveaxis(middle, 2 + hidden, 0).reshape(3, -1, 6, 9)
    grid = (moved @ _MONOMIALS).reshape(3, -1, 6, 3, 3)
    shifted = np.zeros((3, grid.shape[1], 12, 4, 3))
    shifted[:, :, :6, :3] = shifted[:, :, 6:, 1:] = grid
    M = shifted.reshape(3, -1, 12, 12)
    lengths = np.sqrt(np.einsum("kbij,kbij->bi", M, M))
    return np.asarray(M / np.where(lengths > 0.0, lengths, 1.0)[..., None])


def leading(M: Floats) -> tuple[Floats, NDArray[np.intp], Floats]:
    """Choose phi so that the matrix at half a turn from it is as regular as possible.

    Returns
    -------
    inverse : ndarray, shape (B, 12, 12)
        The inverse of that matrix.
    chosen : ndarray of int, shape (B,)
        Index of the chosen one of `PHASES`.
    regularity : ndarray, shape (B,)
        One over the Frobenius condition number; about 1e-16 where no phi is good.
    """
    c, s = np.cos(PHASES)[:, None, None], np.sin(PHASES)[:, None, None]
    A = M[0, :, None] - c * M[1, :, None] - s * M[2, :, None]
    inverses = _inverses(A)
    sizes = np.einsum("bpij,bpij->bp", inverses, inverses) * np.einsum("bpij,bpij->bp", A, A)
    chosen = np.argmin(sizes, axis=1)
    every = np.arange(len(chosen))
    return inverses[every, chosen], chosen, 1.0 / np.sqrt(sizes[every, chosen])


def _inverses(A: Floats) -> Floats:
    """Return inverses (..., 12, 12); when one matrix is exactly singular, all are changed by some roundings."""
    try:
        return np.asarray(np.linalg.inv(A))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.inv(A + 1e-13 * np.random.default_rng(12).normal(size=(12, 12))))


def roots(middle: Floats, hidden: int) -> tuple[NDArray[np.intp], Complex]:
    """Return candidates for the common roots, complex ones too, and of each complex pair one.

    Parameters
    ----------
    middle : ndarray, shape (B, 6, 3, 3, 3)
    hidden : 0, 1 or 2

    Returns
    -------
    owner : ndarray of int, shape (m,)
        Index of the set of equations to which each belongs.
    angles : ndarray of complex, shape (m, 3)
        The angles, those of spurious roots among them.

    Raises
    ------
    LinAlgError
        The equations are exactly degenerate.
    """
    M = matrices(middle, hidden)
    inverse, chosen, _ = leading(M)
    phi = PHASES[chosen]
    c, s = np.cos(phi)[:, None, None], np.sin(phi)[:, None, None]
    companion = np.zeros((len(phi), 24, 24))
    companion[:, :12, 12:] = np.eye(12)
    companion[:, 12:, :12] = -inverse @ (M[0] + c * M[1] + s * M[2])
    companion[:, 12:, 12:] = -2.0 * inverse @ (c * M[2] - s * M[1])
    x, vectors = np.linalg.eig(companion)
    ahead, back = 1.0 + 1j * x, 1.0 - 1j * x
    sizes = np.abs(ahead), np.abs(back)
    kept = (x.imag >= 0.0) & (sizes[0] > FARTHEST * sizes[1]) & (sizes[1] > FARTHEST * sizes[0])
    owner = np.nonzero(kept)[0]
    x, columns = x[kept], np.swapaxes(vectors, 1, 2)[kept]
    # The vector is (m, x m): the larger half loses fewer digits.
    monomials = np.where(np.abs(x[:, None]) < 1.0, columns[:, :12], columns[:, 12:]).reshape(-1, 4, 3)
    angles = np.empty((len(x), 3), dtype=np.complex128)
    angles[:, hidden] = phi[owner] - 1j * np.log(ahead[kept] / back[kept])
    first, second = (k for k in range(3) if k != hidden)
    every, squares = np.arange(len(x)), np.abs(monomials)
    # The largest column holds the powers of x_u, the largest row those of x_v.
    angles[:, first] = _twice_atan(monomials[every, :, np.argmax(squares.sum(axis=1), axis=1)])
    angles[:, second] = _twice_atan(monomials[every, np.argmax(squares.sum(axis=2), axis=1)])
    return owner, angles


def _twice_atan(powers: Complex) -> Complex:
    """Return 2 atan x from powers of x, shape (m, p), up to a factor.

    The larger two of neighbouring powers are compared as homogeneous coordinates, so that half a turn, where x is
    infinite, is nothing special.
    """
    last = powers.shape[1] - 1
    low = np.where(np.abs(powers[:, 0]) >= np.abs(powers[:, last]), 0, last - 1)
    every = np.arange(len(powers))
    cosine, sine = powers[every, low], powers[every, low + 1]
    with np.errstate(divide="ignore", invalid="ignore"):  # x = i and -i are at infinity, where no root is looked for
        return np.asarray(-1j * np.log((cosine + 1j * sine) / (cosine - 1j * sine)))
