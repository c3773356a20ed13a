"""The cubic with given velocities at both ends."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import Field
from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.path_types import PathType, coordinates
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths._boundary import boundary_polynomial, in_seconds

DURATION = Field("duration", "T", "time to which the velocities belong", "number", 1.0, low=0.0, above=True, unit="s")
VELOCITIES = (
    Field("v_start", "v_i", "velocity at the start", "vector", unit="q/s"),
    Field("v_end", "v_f", "velocity at the end", "vector", unit="q/s"),
)


def make(knots: NDArray[np.float64], options: dict[str, Any]) -> PolynomialPath:
    """Return the cubic Hermite curve.

    References
    ----------
    Notes 6.45-6.56 and 6.164-6.182. Their form q_i + Delta q (a s^3 + b s^2 + c s) with one a, b, c for a vector needs
    Delta q_j != 0 in every coordinate and end velocities along it; Hermite's form needs neither
    (`armlab.kin.paths.polynomial.doubly_normalised` is theirs).
    """
    m, duration = knots.shape[1], options["duration"]
    v_start, v_end = (coordinates(options[key], key, m) for key in ("v_start", "v_end"))
    ends = (in_seconds(values, duration) for values in ([knots[0], v_start], [knots[1], v_end]))
    return PolynomialPath(Piecewise(np.array([0.0, 1.0]), boundary_polynomial(*ends)[None]), duration)


PATH = PathType(
    "cubic",
    "Cubic with end velocities",
    6,
    make,
    least=2,
    most=2,
    fields=(*VELOCITIES, DURATION),
    formula=r"X(s)=a_0+a_1s+a_2s^2+a_3s^3",
    says="Four coefficients for both ends and the velocities there.",
)
