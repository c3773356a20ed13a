"""Elbow-type (anthropomorphic) 3R: joint 1 turns the plane of a 2R, to its front or to its back.

    cos th3 = (p_x² + p_y² + (p_z − d1)² − L2² − L3²) / (2 L2 L3),   th3 of both signs
    th1 = atan2(p_y, p_x) or atan2(−p_y, −p_x)
    cos th1 p_x + sin th1 p_y = (L2 + L3 c3) c2 − L3 s3 s2,   p_z − d1 = L3 s3 c2 + (L2 + L3 c3) s2

4.85, 4.92-4.94 print p_z for p_z − d1, and 4.101 adds the first two equations without their factors. On axis 1 joint 1
is free; with L2 = L3 and the target in the shoulder joint 2 is free as well.

References
----------
Notes 4.83-4.105, corrected; Siciliano et al., *Robotics*, 2.12.4.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._place import places, solve_place
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why joint 1 turns the plane of a planar 2R; None when it does not."""
    return known_structure(arm).why if places(arm) and known_structure(arm).key == "elbow" else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_place(arm, T, "The target is out of reach of upper arm and forearm from the shoulder.")


CLOSED = ClosedForm("elbow", "Elbow 3R", 70, fits, solve)
