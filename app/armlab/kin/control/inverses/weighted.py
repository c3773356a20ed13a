"""The weighted pseudo-inverse: the joint speeds with the least qdot^T W qdot among those that come closest to v.

    qdot = W^-1 J^T (J W^-1 J^T)^-1 v

A large weight keeps a joint still; it makes no difference where J is square and regular. At a singularity it is taken
in the sense of the pseudo-inverse of J W^(-1/2).

References
----------
Whitney 1969; notes 5.116-5.123 with another norm.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from armlab.errors import InputError
from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import CUTOFF, Floats, RateInverse, RateStep, pseudo_inverse_speeds
from armlab.kin.field import Field


def speeds(J: Floats, v: Floats, options: Mapping[str, Any]) -> RateStep:
    """Return the weighted joint speeds; the sigma_min in the result is that of J itself."""
    n = J.shape[1]
    weights = np.ones(n) if options["weights"] is None else options["weights"]
    if len(weights) not in (1, n):
        raise InputError(f"weights: expected {n} positive numbers, one for each joint, got {len(weights)}")
    own = decomposed(J)
    regular = own.sigma_min > CUTOFF * (own.sigma[0] if len(own.sigma) else 0.0)
    if regular and len(J) >= n:
        # Only one qdot comes closest to v, whatever the weights.
        return RateStep(pseudo_inverse_speeds(own, v), 0.0, own.sigma_min)
    root = 1.0 / np.sqrt(np.broadcast_to(weights, (n,)))
    # Weights far apart make singular values small, too, but no direction is lost by them.
    qdot = root * pseudo_inverse_speeds(decomposed(J * root), v, 0.0 if regular else CUTOFF)
    return RateStep(qdot, 0.0, own.sigma_min)


INVERSE = RateInverse(
    "weighted",
    "Weighted pseudo-inverse",
    5,
    (Field("weights", "w", "weights, one for each joint: large keeps it still", "list", None, 1e-6, 1e6),),
    speeds,
    r"\dot q=W^{-1}J^T(JW^{-1}J^T)^{-1}v",
)
