"""A straight path from one waypoint to another with a scalar function f as its course: q_i + (q_f - q_i) f(s)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.path import Path

Floats = NDArray[np.float64]
Course = Callable[[Floats, int], Floats]
"""``f(s, order)``: the derivative of a given order of a function with f(0) = 0 and f(1) = 1."""


class Template(Path):
    """Notes 6.50 and 6.62: the same course for every coordinate, so a straight line in any space.

    Parameters
    ----------
    knots : ndarray, shape (2, m)
    course : callable
        See `Course`.
    """

    def __init__(self, knots: Floats, course: Course) -> None:
        self.start, self.change, self.course = knots[0], knots[1] - knots[0], course
        self.m, self.pieces = knots.shape[1], np.zeros(0)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        found = []
        for order in orders:
            values = self.course(s, order)[..., None] * self.change
            found.append(values + self.start if order == 0 else values)
        return found
