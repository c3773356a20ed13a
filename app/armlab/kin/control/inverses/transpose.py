"""The transpose: qdot = alpha J^T v, no inverse at all.

It goes downhill, not where it is told: J J^T v is not along v. Without a given alpha the one is taken for which J qdot
comes closest to v: alpha = v^T J J^T v / |J J^T v|^2.

References
----------
Notes 4.123-4.126 for the error as v; the step size after Buss, *Introduction to inverse kinematics*, 2004, equation 8.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import Floats, RateInverse, RateStep
from armlab.kin.field import Field

NOTHING = 1e-12
"""Fraction of sigma_max^2 |v|: when |J J^T v| is below it, no joint moves the tool along v."""


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return alpha J^T v; zero where no joint moves the tool along v."""
    found = decomposed(J)
    slope, alpha = J.T @ v, options["alpha"]
    if alpha is None:
        moved = J @ slope
        largest = float(found.sigma[0]) ** 2 * float(np.linalg.norm(v)) if len(found.sigma) else 0.0
        square = float(moved @ moved)
        alpha = float(slope @ slope) / square if square > (NOTHING * largest) ** 2 else 0.0
    return RateStep(alpha * slope, 0.0, found.sigma_min)


INVERSE = RateInverse(
    "transpose",
    "Transpose αJᵀ",
    6,
    (
        Field(
            "alpha", "α", "step size; left out: the one that serves v best", "number", None, 1e-6, 1e6, unit="1/sigma²"
        ),
    ),
    speeds,
    r"\dot q=\alpha J^Tv",
)
