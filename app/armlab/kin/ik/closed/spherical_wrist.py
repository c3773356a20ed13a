"""Six joints with a spherical wrist: the wrist centre is placed by joints 1 to 3, then joints 4 to 6 turn the hand.

The position of the wrist centre, p − d6 z6 in the usual table, does not depend on the wrist. Any three joints before it
will do: the shoulder and elbow offsets of the PUMA, the slide of the Stanford and the Unimate. With axes 4 and 6 in one
line only the sum or difference of q4 and q6 is fixed.

References
----------
Pieper 1968; notes, section 4.3.2; Siciliano et al., *Robotics*, 2.12.3-2.12.5.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._wrist import solve_wrist_arm
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of


def fits(arm: Arm) -> str | None:
    """Return a sentence why position and orientation can be solved separately; None when they cannot."""
    structure = known_structure(arm)
    fitting = structure.key == "spherical_wrist" and arm.n == 6 and arm.task.key == "pose" and structure.free == 0
    return structure.why if fitting else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_wrist_arm(screws_of(arm), T)


CLOSED = ClosedForm("spherical_wrist", "Spherical wrist", 100, fits, solve)
