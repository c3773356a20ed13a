"""The singular values of the task Jacobian without units: lengths in length scales of the arm, half its reach."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.check import tolerance
from armlab.content.reader import Table
from armlab.kin.arm import Arm
from armlab.kin.spare import task_jacobian

SIGMA = 0.02
"""A singular value below this counts as zero: what a hand on a slider can find."""

LARGEST_SIGMA = 0.2
"""With a larger one a good part of all configurations would count as singular."""


def singular_values(arm: Arm, q: ArrayLike) -> NDArray[np.float64]:
    """Return them, descending, shape (min(m, n),).

    Rows that are lengths are divided by the length scale, columns of sliding joints multiplied by it, so that all
    entries are pure numbers.
    """
    J = task_jacobian(arm, np.asarray(q, dtype=np.float64)) * np.where(arm.revolute, 1.0, arm.length_scale)
    return np.asarray(np.linalg.svd(J, compute_uv=False))


def read_sigma(table: Table) -> float:
    """Take ``sigma``: what a singular value has to be below to count as zero."""
    value = tolerance(table, "sigma", SIGMA)
    if value > LARGEST_SIGMA:
        raise table.fail("sigma", f"expected at most {LARGEST_SIGMA:g}, got {value:g}")
    return value
