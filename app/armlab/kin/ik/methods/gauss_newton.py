"""Gauss-Newton: the pseudo-inverse step dq = J# e, the shortest of all that would remove the linearised error.

Quadratic near the solution, and it jumps near a singularity; the shared loop shortens a step that makes things worse.

References
----------
Notes 4.115-4.116; for m < n the printed formula should read J# = J^T (J J^T)^-1.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from armlab.kin.ik.method import Method

CUTOFF = 1e-6
"""Singular values, relative to the largest, below which one is taken as zero; J is dimensionless."""


def step(J: Sequence[Sequence[float]], e: Sequence[float], gain: float) -> list[float]:
    """Return gain times the pseudo-inverse step."""
    with np.errstate(all="ignore"):  # A target at the end of the numbers; the loop takes such a step for none.
        dq: list[float] = (gain * (np.linalg.pinv(np.asarray(J), rcond=CUTOFF) @ np.asarray(e))).tolist()
    return dq


METHOD = Method("gauss_newton", "Gauss–Newton (pseudo-inverse)", 2, step, gain=1.0, closed=False)
