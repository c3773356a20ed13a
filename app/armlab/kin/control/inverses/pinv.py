"""The pseudo-inverse: qdot = J# v, the shortest of the joint speeds that come closest to v.

Where J has full row rank that is J^T (J J^T)^-1 v and v is met exactly. Elsewhere that formula does not exist (the
notes use it all the same, after 5.123): singular values below a cutoff count as zero, and what v has outside of the
range of J is left out.

References
----------
Notes 5.116-5.131.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import CUTOFF, Floats, RateInverse, RateStep, pseudo_inverse_speeds
from armlab.kin.field import Field


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return J# v."""
    found = decomposed(J)
    return RateStep(pseudo_inverse_speeds(found, v, options["cutoff"]), 0.0, found.sigma_min)


INVERSE = RateInverse(
    "pinv",
    "Pseudo-inverse J#",
    2,
    (
        Field(
            "cutoff",
            "ε",
            "singular values below this fraction of the largest count as zero",
            "number",
            CUTOFF,
            0.0,
            0.5,
        ),
    ),
    speeds,
    r"\dot q=J^{\#}v",
)
