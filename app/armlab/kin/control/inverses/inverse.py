"""The inverse itself: qdot = J^-1 v, for as many joints as components and away from singularities.

Beside a singularity its joint speeds grow like 1 / sigma_min; at one there is no inverse, and it says so.

References
----------
Notes 5.99.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import Floats, RateInverse, RateStep


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return J^-1 v, or the reason why J has no inverse."""
    m, n = J.shape
    found = decomposed(J)
    if m != n:
        return RateStep(None, 0.0, found.sigma_min, f"J is {m} × {n}: only a square matrix has an inverse")
    if found.singular:
        return RateStep(None, 0.0, found.sigma_min, "J is singular here: J⁻¹ does not exist")
    return RateStep(found.spread(1.0 / found.sigma, v), 0.0, found.sigma_min)


INVERSE = RateInverse("inverse", "Inverse J⁻¹", 1, (), speeds, r"\dot q=J^{-1}v")
