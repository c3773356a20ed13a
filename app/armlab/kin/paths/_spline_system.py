"""The tridiagonal system for the velocities at the knots of a cubic spline, and the cubics from them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError

Floats = NDArray[np.float64]

MOST_SHOWN = 2000
"""Largest number of rows of a full matrix that is shown; the system is solved by its three diagonals."""


@dataclass(frozen=True, eq=False)
class SplineSystem:
    """A tridiagonal matrix and right sides.

    Attributes
    ----------
    lower, diagonal, upper : ndarray, shape (n,)
        ``lower[0]`` and ``upper[-1]`` are not used.
    right : ndarray, shape (n, m)
    first : int
        Number (from 1) of the knot whose velocity is the first unknown.
    """

    lower: Floats
    diagonal: Floats
    upper: Floats
    right: Floats
    first: int

    @property
    def matrix(self) -> Floats:
        """The full matrix, shape (n, n); `InputError` when it is too large to be shown."""
        n = len(self.diagonal)
        if n > MOST_SHOWN:
            raise InputError(f"matrix: {n} rows; at most {MOST_SHOWN} are written out")
        return np.diag(self.diagonal) + np.diag(self.lower[1:], -1) + np.diag(self.upper[:-1], 1)

    def solve(self) -> Floats:
        """Return the unknown velocities, shape (n, m)."""
        # Only here: a tenth of a second at the start of the lab.
        from scipy.linalg import solve_banded  # type: ignore[import-untyped]

        n = len(self.diagonal)
        if n == 0:
            return np.zeros_like(self.right)
        bands = np.zeros((3, n))
        bands[0, 1:], bands[1], bands[2, :-1] = self.upper[:-1], self.diagonal, self.lower[1:]
        return np.asarray(solve_banded((1, 1), bands, self.right))


def clamped_system(h: Floats, q: Floats, v_start: Floats, v_end: Floats) -> SplineSystem:
    """Return the system for the N - 2 inner velocities.

    References
    ----------
    Notes 6.93-6.95. In 6.95 the squares h_k^2 and h_{k+1}^2 are swapped, which even intervals hide; 6.94 is right.
    """
    before, after = h[:-1], h[1:]
    steps = np.diff(q, axis=0)
    right = 3.0 * ((before / after)[:, None] * steps[1:] + (after / before)[:, None] * steps[:-1])
    lower, diagonal, upper = after.copy(), 2.0 * (before + after), before.copy()
    if len(right):
        right[0] -= lower[0] * v_start
        right[-1] -= upper[-1] * v_end
    return SplineSystem(lower, diagonal, upper, right, 2)


def natural_system(h: Floats, q: Floats, a_start: Floats, a_end: Floats) -> SplineSystem:
    """Return the system for all N velocities with given end accelerations; both zero: the natural spline.

    The first row is 2 v_1 + v_2 = 3 (q_2 - q_1) / h_1 - a_1 h_1 / 2, and so at the other end.
    """
    zero = np.zeros(q.shape[1])
    inner = clamped_system(h, q, zero, zero)
    steps = np.diff(q, axis=0)
    first = 3.0 * steps[0] / h[0] - 0.5 * h[0] * a_start
    last = 3.0 * steps[-1] / h[-1] + 0.5 * h[-1] * a_end
    return SplineSystem(
        np.concatenate([[0.0], inner.lower, [1.0]]),
        np.concatenate([[2.0], inner.diagonal, [2.0]]),
        np.concatenate([[1.0], inner.upper, [0.0]]),
        np.concatenate([first[None], inner.right, last[None]]),
        1,
    )


def cubics(h: Floats, q: Floats, v: Floats) -> Floats:
    """Return a_k0 to a_k3 of each cubic from positions and velocities at the knots, shape (N-1, 4, m).

    References
    ----------
    The solution of 6.91, whose second row must read (2 h_k, 3 h_k^2).
    """
    h = h[:, None]
    slope = np.diff(q, axis=0) / h
    return np.stack(
        [q[:-1], v[:-1], (3.0 * slope - 2.0 * v[:-1] - v[1:]) / h, (v[:-1] + v[1:] - 2.0 * slope) / h**2], axis=1
    )
