"""Arms with one joint.

References
----------
Notes 4.3, the simplest case.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._plane import heading, plane_of
from armlab.kin.ik.closed_form import FREE_ANGLES, ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector, across, angle_about, screws_of


def fits(arm: Arm) -> str | None:
    """Return a sentence why the one joint follows from the target; None when it does not."""
    known = arm.n == 1 and (arm.task.rotation == "phi" or (arm.task.position == "xyz" and arm.task.rotation == "none"))
    if not known:
        return None
    s = screws_of(arm)
    turning = s.kinds == "R" and (arm.task.rotation == "none" or abs(abs(s.z[0][2]) - 1.0) < 1e-9)
    return known_structure(arm).why if turning or (s.kinds == "P" and arm.task.rotation == "none") else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return the only solution, T (4, 4) in frame 0; none when the target lies off the path of the joint."""
    s = screws_of(arm)
    if s.kinds == "P":
        return Found(
            [np.array([s.z[0] @ (T[:3, 3] - s.home[:3, 3])])],
            none="The target does not lie on the line of the prismatic joint.",
        )
    if arm.task.rotation == "phi":
        plane = plane_of(s)
        return Found([np.array([plane.flats[0].way.real * heading(plane, T)])])
    start, end = s.home[:3, 3] - s.o[0], T[:3, 3] - s.o[0]
    if across(s.z[0], start) <= 1e-10 * s.scale:
        family = "The tool point lies on the axis of joint 1: q1 may have any value."
        return Found([np.array([q]) for q in FREE_ANGLES], (family,))
    return Found(
        [np.array([angle_about(s.z[0], start, end)])], none="The target does not lie on the circle of the tool point."
    )


CLOSED = ClosedForm("single", "One joint", 5, fits, solve)
