"""Rest-to-rest laws that are a polynomial of odd degree."""

from __future__ import annotations

import numpy as np

from armlab.kin.motion.law import PolynomialLaw
from armlab.kin.motion.piecewise import Piecewise


def rest_law(coefficients: tuple[int, ...], duration: float, distance: float) -> PolynomialLaw:
    """Return s(t) = distance (a tau^d + b tau^(d-1) + ...), tau = t / T, from coefficients, highest power first."""
    rising = np.array(coefficients[::-1], dtype=float) * distance
    return PolynomialLaw(Piecewise(np.array([0.0, 1.0]), rising[None, :, None]).local(duration))
