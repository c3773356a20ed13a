"""Cylindrical arm: angle, height and distance from the axis, the distance with both signs.

References
----------
Notes 3.9-3.11 and section 1.7.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._planar_fit import plane_for, solve_in_plane
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why height and plane can be solved separately; None when they cannot."""
    return None if plane_for(arm, "cylindrical") is None else known_structure(arm).why


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    plane = plane_for(arm, "cylindrical")
    assert plane is not None
    found = solve_in_plane(arm, T, plane)
    return (
        found
        if found.q
        else Found([], (), "The target is nearer to the axis than the offset of the sliding arm allows.")
    )


CLOSED = ClosedForm("cylindrical", "Cylindrical arm", 40, fits, solve)
