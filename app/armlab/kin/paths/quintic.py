"""The quintic with given velocities and accelerations at both ends."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import Field
from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.path_types import PathType, coordinates
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths._boundary import boundary_polynomial, in_seconds
from armlab.kin.paths.cubic import DURATION, VELOCITIES

ACCELERATIONS = (
    Field("a_start", "a_i", "acceleration at the start", "vector", unit="q/s²"),
    Field("a_end", "a_f", "acceleration at the end", "vector", unit="q/s²"),
)


def make(knots: NDArray[np.float64], options: dict[str, Any]) -> PolynomialPath:
    """Return the quintic Hermite curve.

    References
    ----------
    Notes 6.65-6.73 (six conditions, degree five; the text says six). At rest at both ends it is q_i + Delta q (6 s^5 -
    15 s^4 + 10 s^3); 6.74 prints 5 for 15.
    """
    m, duration = knots.shape[1], options["duration"]
    keys = ("v_start", "a_start"), ("v_end", "a_end")
    ends = (
        in_seconds([knot, *(coordinates(options[key], key, m) for key in pair)], duration)
        for knot, pair in zip(knots, keys, strict=True)
    )
    return PolynomialPath(Piecewise(np.array([0.0, 1.0]), boundary_polynomial(*ends)[None]), duration)


PATH = PathType(
    "quintic",
    "Quintic with end velocities and accelerations",
    7,
    make,
    least=2,
    most=2,
    fields=(*VELOCITIES, *ACCELERATIONS, DURATION),
    formula=r"X(s)=\sum_{k=0}^{5}a_ks^k",
    says="Six coefficients for both ends, velocities and accelerations.",
)
