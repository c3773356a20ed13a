"""The singular value decomposition of one small matrix, by a direct call of LAPACK, which is quicker than NumPy's."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.iterate.problem import SINGULAR

Floats = NDArray[np.float64]


class Decomposed(NamedTuple):
    """J = U diag(sigma) Vt.

    Attributes
    ----------
    U, sigma, Vt : ndarray, shapes (m, r), (r,) and (r, n), r = min(m, n)
        sigma descending.
    """

    U: Floats
    sigma: Floats
    Vt: Floats

    @property
    def sigma_min(self) -> float:
        """The smallest of the min(m, n) singular values; 0 when there is none."""
        return float(self.sigma[-1]) if len(self.sigma) else 0.0

    @property
    def singular(self) -> bool:
        """Whether J has lost rank: sigma_min is at most `SINGULAR` of the largest."""
        return not len(self.sigma) or bool(self.sigma[-1] <= SINGULAR * self.sigma[0])

    def spread(self, factors: Floats, v: Floats) -> Floats:
        """Return the sum of the terms factor v (u^T v) over the singular vectors, (n,)."""
        return np.asarray((factors * (v @ self.U)) @ self.Vt)


def decomposed(J: Floats) -> Decomposed:
    """Return the singular value decomposition of a finite matrix (m, n)."""
    if not J.size:
        return Decomposed(np.zeros((J.shape[0], 0)), np.zeros(0), np.zeros((0, J.shape[1])))
    # The transpose of an array of NumPy is what LAPACK takes without a copy.
    V, sigma, Ut, failed = _driver()(J.T, full_matrices=0)
    if failed:
        return Decomposed(*np.linalg.svd(J, full_matrices=False))
    return Decomposed(Ut.T, sigma, V.T)


def null_directions(J: Floats, cutoff: float) -> Floats:
    """Return an orthonormal basis of the null space of a finite matrix (m, n), (n, k).

    Parameters
    ----------
    J : ndarray, shape (m, n)
    cutoff : float
        Singular values not above this part of the largest count as zero.
    """
    if not J.size:
        return np.eye(J.shape[1])
    _, sigma, Vt = np.linalg.svd(J)
    return np.asarray(Vt[np.count_nonzero(sigma > cutoff * sigma[0]) :].T)


@cache
def _driver() -> Callable[..., Any]:
    """Return LAPACK's routine; SciPy is imported at the first call, to keep the start short."""
    from scipy.linalg import lapack  # type: ignore[import-untyped]

    found: Callable[..., Any] = lapack.dgesdd
    return found
