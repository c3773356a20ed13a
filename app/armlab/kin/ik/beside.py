"""Starts beside nearly singular solutions: what a fold has split in two, descents from afar find but once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import many_at_once
from armlab.kin.ik.nearly_still import SLACK, slack_ways

Vector = NDArray[np.float64]

DISTANCES = (1e-5, 1e-4, 1e-3, 1e-2, 3e-2)
"""Lengths of the steps away from a solution, over all joints, in radians or length scales. Nearer than the first, two
are told apart by nothing; farther than the last, closed forms and descents from anywhere find both.
"""


def beside(arm: Arm, rows: Sequence[Vector], G: NDArray[np.floating]) -> list[Vector]:
    """Return starts on both sides of solutions (n,), along the directions in which the tool hardly moves there.

    Parameters
    ----------
    arm : Arm
    rows : sequence of ndarray, shape (n,)
        Solutions; those that are far from any singularity add nothing.
    G : ndarray, shape (4, 4)
        Target in frame 0.
    """
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    found: list[Vector] = []
    for q, J in zip(rows, many_at_once(arm).linearised(np.array(rows).reshape(-1, arm.n), G)[0], strict=True):
        _, values, basis = np.linalg.svd(J)
        slack = basis[: len(values)][values < SLACK * values[0]]
        if len(slack):
            found += [q + far * way * scales for way in slack_ways(slack) for far in DISTANCES]
    return found
