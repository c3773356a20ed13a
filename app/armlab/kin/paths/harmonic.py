"""The harmonic course (1 - cos pi s) / 2: half a wave of a cosine."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._template import Template

Floats = NDArray[np.float64]


def course(s: Floats, order: int) -> Floats:
    """Return the derivative of a given order of (1 - cos pi s) / 2 with respect to s."""
    if order == 0:
        return 0.5 - 0.5 * np.cos(math.pi * s)
    # Derivatives of -cos turn it by a quarter wave each.
    return np.asarray(-0.5 * math.pi**order * np.cos(math.pi * s + order * math.pi / 2.0))


def make(knots: Floats, options: dict[str, Any]) -> Template:
    """Return the path. Notes 6.57-6.64; the last condition of 6.60 must be at 1, not at T."""
    return Template(knots, course)


PATH = PathType(
    "harmonic",
    "Harmonic",
    12,
    make,
    least=2,
    most=2,
    spaces=("joint",),
    formula=r"X(s)=X_A+\frac{1-\cos\pi s}{2}(X_B-X_A)",
    says="At rest at both ends as far as s is concerned.",
)
