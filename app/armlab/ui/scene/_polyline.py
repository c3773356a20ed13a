"""Lines of many points drawn with few.

The browser draws each segment of a fat line by itself, so on a machine without a graphics card a way of 160
segments costs as much as the whole arm.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

ROUGHNESS = 0.0004
"""How far a drawn line may be from the true one, in sizes of the arm: far less than it is thick."""


def simplified(points: ArrayLike, tolerance: float) -> NDArray[np.intp]:
    """Return which points of a line to keep, so that it stays within a tolerance of what it was.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        At least one.
    tolerance : float
        Largest distance from a left out point to the line that is drawn, m.

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
    keep[[0, -1]] = True
    open_spans = [(0, len(at) - 1)]
    while open_spans:
        first, last = open_spans.pop()
        if last - first < 2:
            continue
        away = _distances(at[first + 1 : last], at[first], at[last])
        worst = int(np.argmax(away))
        if away[worst] > tolerance:
            middle = first + 1 + worst
            keep[middle] = True
            open_spans += [(first, middle), (middle, last)]
    return np.flatnonzero(keep)


def _distances(points: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distances from points (k, 3) to a segment, which may be a point."""
    along, offset = end - start, points - start
    square = float(along @ along)
    share = np.clip(offset @ along / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(points))
    away: Floats = np.linalg.norm(offset - share[:, None] * along, axis=1)
    return away
