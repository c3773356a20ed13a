"""Planar arms of three joints with orientation, and of two joints with a slide.

Where joint 3 turns, the wanted angle gives the place of its axis, p − l3 (cos phi, sin phi) in a 3R: a planar 2R
remains. Where joint 1 turns and joint 3 slides, the same holds seen from the tool.

References
----------
Notes 4.5-4.7 and section 4.3.1; Siciliano et al., *Robotics*, 2.12.1.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._planar_fit import plane_for, solve_in_plane
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why the task is what motion in the arm's plane can do; None when it is not."""
    return None if plane_for(arm, "planar") is None else known_structure(arm).why


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    plane = plane_for(arm, "planar")
    assert plane is not None
    found = solve_in_plane(arm, T, plane)
    if found.q or arm.task.rotation != "phi":
        return found
    return Found(
        [], (), "The position that this angle requires of the last joint is out of reach of the joints before it."
    )


CLOSED = ClosedForm("planar", "Planar arm", 20, fits, solve)
