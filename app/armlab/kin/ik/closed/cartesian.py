"""Cartesian arm: three slides, and the position is linear in the joint values.

References
----------
Notes, section 1.7.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of

INDEPENDENT = 1e-9
"""Smallest singular value with which the directions of the slides count as independent."""


def fits(arm: Arm) -> str | None:
    """Return a sentence why the position is linear in the joint values; None when it is not."""
    structure = known_structure(arm)
    if structure.key != "cartesian" or arm.n != len(arm.task.position):
        return None
    return structure.why if np.linalg.svd(_directions(arm))[1][-1] > INDEPENDENT else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return the only solution, T (4, 4) in frame 0."""
    gap = (T[:3, 3] - screws_of(arm).home[:3, 3])[arm.task.coordinates]
    return Found([np.asarray(np.linalg.solve(_directions(arm), gap), dtype=np.float64)])


def _directions(arm: Arm) -> Vector:
    return screws_of(arm).z.T[arm.task.coordinates]


CLOSED = ClosedForm("cartesian", "Cartesian arm", 50, fits, solve)
