"""Accuracy and repeatability of positions that an arm attains when it goes to the same place again and again."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats

Floats = NDArray[np.float64]


class Scatter(NamedTuple):
    """Accuracy and repeatability of attained positions.

    Attributes
    ----------
    middle : ndarray, shape (3,)
        Mean of the attained positions, metres.
    accuracy : float
        AP, the distance of the mean from the commanded position, metres: the systematic error.
    distances : ndarray, shape (n,)
        Of the attained positions from their mean, metres.
    """

    middle: Floats
    accuracy: float
    distances: Floats

    @property
    def mean_distance(self) -> float:
        """Mean m of the distances, metres."""
        return float(self.distances.mean())

    @property
    def deviation(self) -> float:
        """Standard deviation S of the distances, with n - 1, metres."""
        return float(self.distances.std(ddof=1))

    @property
    def repeatability(self) -> float:
        """RP, the mean distance from the mean plus three of its standard deviations, metres: the scatter."""
        return self.mean_distance + 3.0 * self.deviation


def scatter_of(attained: ArrayLike, commanded: ArrayLike) -> Scatter:
    """Return the accuracy AP and the repeatability RP of positions.

    With the mean c of n positions and their distances l_j from it, of mean m and standard deviation S (with n - 1):
    ``AP = |c - commanded|`` and ``RP = m + 3 S``. RP is the radius of a sphere about c, so it does not depend on where
    the arm was sent.

    Parameters
    ----------
    attained : array_like, shape (n, 3)
        Metres, n at least 2.
    commanded : array_like, shape (3,)
        Metres.

    References
    ----------
    Notes, section 1.7; ISO 9283:1998, sections 7.2.1 and 7.2.2, for positions.

    Examples
    --------
    >>> found = scatter_of([[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], [0.0, 0.0, 0.0])
    >>> found.accuracy, found.repeatability
    (2.0, 1.0)
    """
    points = as_floats(attained, "attained", "at least two positions of three numbers")
    if points.ndim != 2 or points.shape[1:] != (3,) or len(points) < 2 or not np.isfinite(points).all():
        raise InputError(f"attained: expected at least two positions of three finite numbers, got shape {points.shape}")
    goal = finite_floats(commanded, "commanded", (3,), "three finite numbers")
    # From the first one on, so that equal positions have no distance by rounding.
    middle = points[0] + (points - points[0]).mean(axis=0)
    distances = np.linalg.norm(points - middle, axis=1)
    return Scatter(middle, float(np.linalg.norm(middle - goal)), distances)
