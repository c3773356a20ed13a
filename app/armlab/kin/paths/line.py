"""The straight line q(s) = q_i + s (q_f - q_i)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.path_types import PathType
from armlab.kin.motion.piecewise import Piecewise


def make(knots: NDArray[np.float64], options: dict[str, Any]) -> PolynomialPath:
    """Return the line between two waypoints. Notes 6.1, 6.100; also 1.27."""
    return PolynomialPath(Piecewise(np.array([0.0, 1.0]), np.stack([knots[0], knots[1] - knots[0]])[None]))


PATH = PathType(
    "line",
    "Straight line",
    1,
    make,
    least=2,
    most=2,
    formula=r"X(s)=X_A+s\,(X_B-X_A)",
    says="Each coordinate changes in proportion to s⟦ (notes 6.1)⟧.",
)
