"""Lines of many points drawn with few.

The browser draws each segment of a fat line by itself, so on a machine without a graphics card a way of 160
segments costs as much as the whole arm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

ROUGHNESS = 0.0004
"""Largest distance of a drawn line from the true one, in sizes of the arm, much less than its thickness."""


def simplified(points: ArrayLike, tolerance: float, ends: ArrayLike = ()) -> NDArray[np.intp]:
    """Return which points of a line to keep, so that it stays within a tolerance of what it was.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        At least one.
    tolerance : float
        Largest distance from a left out point to the line that is drawn, m.
    ends : array_like of int, optional
        First and last points of several lines that stand one behind the other: they are kept, too.

    Returns
    -------
    ndarray of int, shape (k,)
        Ascending; the first and the last point are always kept.

    Source
    ------
    D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the number of points required to represent a
    digitized line or its caricature", Cartographica 10 (1973).
    """
    at = np.asarray(points, dtype=float)
    keep = np.zeros(len(at), dtype=bool)
    keep[[0, -1, *np.asarray(ends, dtype=int)]] = True
    rest = np.flatnonzero(~keep)
    # All spans are halved together: a ragged line has thousands, and each by itself would cost as much as all of them.
    while rest.size:
        ends = np.flatnonzero(keep)
        span = np.searchsorted(ends, rest) - 1
        away = _distances(at[rest], at[ends[span]], at[ends[span + 1]])
        begins = np.diff(span, prepend=-1) > 0
        number = np.cumsum(begins) - 1
        most = np.maximum.reduceat(away, np.flatnonzero(begins))
        open_still = (most > tolerance)[number]
        worst = np.flatnonzero(open_still & (away == most[number]))
        keep[rest[worst[np.unique(number[worst], return_index=True)[1]]]] = True
        rest = rest[open_still & ~keep[rest]]
    return np.flatnonzero(keep)


def _distances(points: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distances from points (k, 3) to segments with ends (k, 3) each; a segment may be a point."""
    along, offset = end - start, points - start
    square = np.einsum("ki,ki->k", along, along)
    share = np.einsum("ki,ki->k", offset, along) / np.where(square > 0.0, square, 1.0)
    away: Floats = np.linalg.norm(offset - np.clip(share, 0.0, 1.0)[:, None] * along, axis=1)
    return away
