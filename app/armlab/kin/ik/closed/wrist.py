"""A spherical wrist alone: the orientation in two ways, with a straight wrist in infinitely many.

References
----------
Siciliano et al., *Robotics*, 2.12.5.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._turning import turn
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of


def fits(arm: Arm) -> str | None:
    """Return a sentence why three rotations about one point make the orientation; None when they do not."""
    structure = known_structure(arm)
    fitting = structure.key == "wrist" and arm.task.rotation == "full" and structure.free == 0
    return structure.why if fitting else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    s = screws_of(arm)
    found = turn((s.z[0], s.z[1], s.z[2]), T[:3, :3] @ s.home[:3, :3].T)
    family = "The wrist is straight: axes 1 and 3 coincide, and only the sum or difference of q1 and q3 is fixed."
    families = (family,) if any(one.free for one in found) else ()
    return Found([np.array(one.q) for one in found], families)


CLOSED = ClosedForm("wrist", "Spherical wrist alone", 80, fits, solve)
