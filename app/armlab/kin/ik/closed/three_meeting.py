"""Six joints whose first three axes meet: the spherical wrist, seen from the tool.

The arm with the order of its joints reversed has a spherical wrist.

References
----------
Pieper 1968; notes, section 4.3.2.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._wrist import solve_wrist_arm
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of
from armlab.kin.transforms import inverse

FAMILY = "Axes 1 and 3 coincide, or a point to be placed lies on an axis: one of the joint values is free."


def fits(arm: Arm) -> str | None:
    """Return a sentence why position and orientation can be solved separately; None when they cannot."""
    structure = known_structure(arm)
    fitting = structure.key == "three_meeting" and structure.joints == (1, 2, 3) and arm.n == 6
    return structure.why if fitting and arm.task.key == "pose" and structure.free == 0 else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    found = solve_wrist_arm(screws_of(arm).reversed(), np.asarray(inverse(T), dtype=np.float64))
    # The sentences count the joints from the tool.
    families = (FAMILY,) if found.families else ()
    none = "" if found.q else "Joints 4, 5 and 6 cannot hold the point where axes 1, 2 and 3 meet, seen from the tool."
    return replace(found, q=[q[::-1].copy() for q in found.q], families=families, none=none)


CLOSED = ClosedForm("three_meeting", "Three axes through one point", 110, fits, solve)
