"""One polynomial through all waypoints, which oscillates between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType

Floats = NDArray[np.float64]

MOST_KNOTS = 31
"""Largest number of waypoints: with more, evenly spaced, rounding alone moves the curve visibly."""

CLOSE = 1e-9
"""Time between two waypoints, as a part of the whole, below which rounding decides on the polynomial."""


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
        _refuse_close(self.places)
        series = np.linalg.solve(chebyshev.chebvander(2.0 * self.places - 1.0, count - 1), knots)
        self._series = [series]
        for _ in range(3):
            self._series.append(
                2.0 * chebyshev.chebder(self._series[-1]) if len(self._series[-1]) > 1 else 0.0 * series[:1]
            )
        self.remarks = _remarks(count - 1)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        u = 2.0 * s - 1.0
        return [np.moveaxis(chebyshev.chebval(u, self._series[order]), 0, -1) for order in orders]


def _refuse_close(places: Floats) -> None:
    """Raise `InputError` when two waypoints are so near in time that no polynomial can be computed."""
    close = np.flatnonzero(np.diff(places) < CLOSE)
    if len(close):
        k = int(close[0]) + 1
        raise InputError(f"waypoint {k + 1}: its time is too close to that of waypoint {k} for one polynomial")


def _remarks(degree: int) -> tuple[str, ...]:
    """Return the remark that a polynomial of this degree wanders; a line does not."""
    if degree < 2:
        return ()
    turns = "1 extreme" if degree == 2 else f"{degree - 1} extremes"
    return (
        f"Degree {degree} with up to {turns} in each coordinate: between waypoints it wanders, the more the nearer to "
        "the ends. A spline does not.",
    )


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
