"""SCARA: the height is one joint, and what remains is a planar arm with orientation.

References
----------
Notes, section 1.7; Siciliano et al., *Robotics*, 2.9.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._planar_fit import plane_for, solve_in_plane
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why height and plane can be solved separately; None when they cannot."""
    return None if plane_for(arm, "scara") is None else known_structure(arm).why


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    plane = plane_for(arm, "scara")
    assert plane is not None
    found = solve_in_plane(arm, T, plane)
    return found if found.q else Found([], (), "Seen from above, the axis of the last joint would be out of reach.")


CLOSED = ClosedForm("scara", "SCARA", 30, fits, solve)
