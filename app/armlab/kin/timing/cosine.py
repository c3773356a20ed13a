"""The cosine law (1 - cos pi tau) / 2."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import positive
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import LawType

Floats = NDArray[np.float64]


class Cosine(Law):
    """Half a wave of a cosine."""

    def __init__(self, duration: float, size: float) -> None:
        self.duration, self.size, self.pieces = duration, size, np.zeros(0)

    def _values(self, t: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        rate = math.pi / self.duration
        found = []
        for order in orders:
            values = -0.5 * self.size * rate**order * np.cos(rate * t + order * math.pi / 2.0)
            found.append(values + 0.5 * self.size if order == 0 else values)
        return found

    def stretched(self, k: float) -> Cosine:
        """Return the same law k times as slow."""
        return Cosine(self.duration * positive(k, "k"), self.size)


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law. Notes 6.62-6.64. Peaks: pi/2 d/T, and pi^2/2 d/T^2 at both ends, where acceleration jumps."""
    return Cosine(duration, distance)


LAW = LawType("cosine", "Cosine", 8, make)
