"""Polar RRP: two angles and a length with both signs.

    q3 = ± gamma,  gamma² = p_x² + p_y² + (p_z − d1)²,   sin q2 = (p_z − d1) / q3,   cos q2 = ± sqrt(1 − sin² q2)
    q1 = atan2(p_y / (q3 cos q2), p_x / (q3 cos q2))

q2 is the elevation, not the joint variable of the table; q3 in the last line is missing in 4.82, where it matters for
two of the four solutions. With p_x = p_y = 0 joint 1 is free, with gamma = 0 joint 2 as well.

References
----------
Notes 4.66-4.82.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._place import places, solve_place
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why the joint values are two angles and a length; None when they are not."""
    return known_structure(arm).why if places(arm) and known_structure(arm).key == "polar" else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_place(arm, T, "The target is nearer to the shoulder than the offset of the prismatic joint allows.")


CLOSED = ClosedForm("polar", "Polar RRP", 60, fits, solve)
