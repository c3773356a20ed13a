"""The intervals between knots with which a spline takes the least time, and the question about them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from armlab.benches.motion.curves.knots import SHORTEST, Knot, checked
from armlab.errors import InputError
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.minimum_time import minimum_time_spline

MOST_KNOTS = 8
"""Largest number of knots whose intervals are optimised here, in one piece of work: some 40 ms, rarely 100 ms; 16 take
0.2 to 1.5 s."""


@dataclass(frozen=True)
class Asked:
    """A question for the fastest intervals.

    Attributes
    ----------
    knots : tuple of (float, float)
    v_max, a_max : float
    ends : str
        Of the spline: ``"clamped"``, ``"natural"`` or ``"both"``.
    """

    knots: tuple[Knot, ...]
    v_max: float
    a_max: float
    ends: str

    def check(self) -> None:
        """Raise `InputError` if there can be no answer."""
        if len(self.knots) > MOST_KNOTS:
            raise InputError(f"knots: intervals are optimised for at most {MOST_KNOTS}, there are {len(self.knots)}")
        for k in range(1, len(self.knots)):
            if self.knots[k][1] == self.knots[k - 1][1]:
                raise InputError(f"knot {k + 1}: the same q as knot {k}; there is no least time between them")


@dataclass(frozen=True)
class Fastest:
    """The fastest intervals.

    Attributes
    ----------
    asked : Asked
    intervals : tuple of float
        h_k, seconds.
    by_distance : float
        Seconds of the same spline with intervals in proportion to distance, as fast as allowed.
    """

    asked: Asked
    intervals: tuple[float, ...]
    by_distance: float

    @property
    def duration(self) -> float:
        """T, the sum of the intervals, seconds."""
        return sum(self.intervals)

    @property
    def before(self) -> float:
        """T of the knots before, seconds."""
        return self.asked.knots[-1][0] - self.asked.knots[0][0]

    @property
    def knots(self) -> tuple[Knot, ...]:
        """The knots at their new times."""
        times = self.asked.knots[0][0] + np.concatenate([[0.0], np.cumsum(self.intervals)])
        if min(self.intervals) < SHORTEST:
            raise InputError(f"intervals: the shortest would be below {1e3 * SHORTEST:g} ms; lower the limits")
        return checked(zip(times.tolist(), (q for _, q in self.asked.knots), strict=True))


def fastest(asked: Asked) -> Fastest:
    """Return the fastest intervals."""
    found = minimum_time_spline([[q] for _, q in asked.knots], Limits(asked.v_max, asked.a_max), ends=asked.ends)
    return Fastest(asked, tuple(found.intervals.tolist()), found.by_distance)
