"""Cubics between timed waypoints with given velocities, such as a table of samples with their rates."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import PolynomialPath, timed
from armlab.kin.motion.path_types import PathType
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths._spline_system import cubics

Floats = NDArray[np.float64]


def make(knots: Floats, options: dict[str, Any]) -> PolynomialPath:
    """Return the cubics; velocities left out are those of a parabola through neighbours, and zero at the ends.

    The velocity is continuous, the acceleration jumps at the waypoints.

    References
    ----------
    Notes 6.45-6.56, one cubic after the other.
    """
    times, velocities = knot_times(knots, options), options["velocities"]
    if velocities is None:
        velocities = np.zeros_like(knots)
        if len(knots) > 2:
            velocities[1:-1] = np.gradient(knots, times, axis=0)[1:-1]
    elif velocities.shape != knots.shape:
        raise InputError(
            f"velocities: expected {knots.shape[0]} rows of {knots.shape[1]}, one for each waypoint, got "
            f"{velocities.shape[0]} of {velocities.shape[1]}"
        )
    return timed(Piecewise(times, cubics(np.diff(times), knots, velocities)))


PATH = PathType(
    "hermite",
    "Cubics with given velocities",
    6,
    make,
    fields=(
        Field(
            "velocities",
            "v_k",
            "velocity at each waypoint, a row each; left out: from neighbours",
            "rows",
            unit="q/s",
        ),
        *TIMES,
    ),
    apart=False,
    formula=r"X_j(s)=\sum_{k=0}^{3}a_{jk}(s-s_j)^k",
    says="A cubic from each knot to the next, with the given velocities where two meet.",
)
