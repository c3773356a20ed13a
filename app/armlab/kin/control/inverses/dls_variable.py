"""Damped least squares, damped only where the smallest singular value is small.

    lambda = lambda_max (1 - (sigma_min / epsilon)^2)   for sigma_min < epsilon, and 0 elsewhere

References
----------
Notes 5.2.1, which leave the schedule open; after Nakamura and Hanafusa 1986, with sigma_min as in Chiaverini, Siciliano
and Egeland 1994, and as in `armlab.kin.ik.iterate.methods.dls_sigma`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import Floats, RateInverse, RateStep, damped_speeds
from armlab.kin.field import Field


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return the joint speeds, damped by the smallest singular value."""
    found = decomposed(J)
    damping = options["lambda_max"] * max(0.0, 1.0 - (found.sigma_min / options["epsilon"]) ** 2)
    return RateStep(damped_speeds(found, v, damping), damping, found.sigma_min)


INVERSE = RateInverse(
    "dls_variable",
    "Damped near singularities",
    4,
    (
        Field("lambda_max", "λ_max", "damping factor at a singularity", "number", 0.01, 0.0, 100.0, unit="sigma²"),
        Field("epsilon", "ε", "σ_min below which it is damped", "number", 0.2, 1e-6, 100.0, unit="sigma"),
    ),
    speeds,
    r"\lambda=\lambda_{max}\left(1-(\sigma_{min}/\epsilon)^2\right)",
)
