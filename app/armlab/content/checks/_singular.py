"""Dimensionless singular values of the task Jacobian: lengths are divided by half the reach of the arm."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.check import tolerance
from armlab.content.reader import Table
from armlab.kin.arm import Arm
from armlab.kin.spare import task_jacobian

SIGMA = 0.02
"""Singular value below which it counts as zero: small enough to be found with a slider."""

LARGEST_SIGMA = 0.2
"""Largest limit of a singular value: with a larger one many configurations would count as singular."""


def singular_values(arm: Arm, q: ArrayLike) -> NDArray[np.float64]:
    """Return them, descending, shape (min(m, n),).

    Rows that are lengths are divided by the length scale, columns of sliding joints multiplied by it, so that all
    entries are pure numbers.
    """
    J = task_jacobian(arm, np.asarray(q, dtype=np.float64)) * np.where(arm.revolute, 1.0, arm.length_scale)
    return np.asarray(np.linalg.svd(J, compute_uv=False))


def read_sigma(table: Table) -> float:
    """Take ``sigma``, the limit below which a singular value counts as zero."""
    value = tolerance(table, "sigma", SIGMA)
    if value > LARGEST_SIGMA:
        raise table.fail("sigma", f"expected at most {LARGEST_SIGMA:g}, got {value:g}")
    return value
