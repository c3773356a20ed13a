"""Damped least squares with constant damping: qdot = J^T (J J^T + lambda I_m)^-1 v.

The joint speeds that minimise |J qdot - v|^2 + lambda |qdot|^2: finite everywhere, and everywhere a little too slow.

References
----------
Notes 5.107-5.115 (lambda as there, not squared; I_m where 5.113 prints I_n); Wampler 1986.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import Floats, RateInverse, RateStep, damped_speeds
from armlab.kin.field import Field


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return the damped joint speeds."""
    found = decomposed(J)
    return RateStep(damped_speeds(found, v, options["lambda"]), options["lambda"], found.sigma_min)


INVERSE = RateInverse(
    "dls_constant",
    "Damped, constant λ",
    3,
    (Field("lambda", "λ", "damping factor", "number", 0.01, 0.0, 100.0, unit="sigma²"),),
    speeds,
    r"\dot q=J^T(JJ^T+\lambda I_m)^{-1}v",
)
