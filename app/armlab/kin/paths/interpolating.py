"""One polynomial through all waypoints, which oscillates between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType

Floats = NDArray[np.float64]

MOST_KNOTS = 31
"""Largest number of waypoints: with more, evenly spaced, rounding alone moves the curve visibly."""


class Interpolating(Path):
    """A polynomial of degree N - 1.

    Attributes
    ----------
    places : ndarray, shape (N,)
        s at the waypoints.
    """

    def __init__(self, knots: Floats, times: Floats) -> None:
        count, self.m = knots.shape
        self.degree, self.pieces = count - 1, np.zeros(0)
        self.duration = float(times[-1] - times[0])
        self.places = (times - times[0]) / self.duration
        series = np.linalg.solve(chebyshev.chebvander(2.0 * self.places - 1.0, count - 1), knots)
        self._series = [series]
        for _ in range(3):
            self._series.append(
                2.0 * chebyshev.chebder(self._series[-1]) if len(self._series[-1]) > 1 else 0.0 * series[:1]
            )
        turns = max(0, count - 2)
        self.remarks = (
            f"Degree {count - 1} with up to {turns} extremes in each coordinate: between waypoints it wanders, the "
            "more the nearer to the ends. A spline does not.",
        )

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        u = 2.0 * s - 1.0
        return [np.moveaxis(chebyshev.chebval(u, self._series[order]), 0, -1) for order in orders]


def make(knots: Floats, options: dict[str, Any]) -> Interpolating:
    """Return the polynomial through the waypoints at their times. Notes, figure 6.1 and the text before it.

    Computed with Chebyshev polynomials, which lose fewer digits than powers of s.
    """
    return Interpolating(knots, knot_times(knots, options))


PATH = PathType(
    "interpolating",
    "One polynomial through all",
    11,
    make,
    most=MOST_KNOTS,
    spaces=("joint", "cartesian"),
    fields=TIMES,
    apart=False,
    rests=False,
    formula=r"X(s)=\sum_{k=0}^{N-1}a_ks^k",
    says="One polynomial through all N knots; with many knots it wanders.",
)
