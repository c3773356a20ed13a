"""Bang-bang: full acceleration for half the time, then full deceleration; the fastest law for bounded acceleration."""

from __future__ import annotations

from typing import Any

from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.piecewise import integrated


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law. Notes 6.112: the triangle of speed. Peaks: 2 d/T and 4 d/T^2."""
    a = 4.0 * distance / duration**2
    return PolynomialLaw(integrated([duration / 2.0] * 2, [a, -a], [0.0, 0.0]))


LAW = LawType("bang_bang", "Bang-bang", 6, make)
