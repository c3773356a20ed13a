"""Planar 2R: the law of cosines for joint 2, two angles for joint 1.

    cos th2 = (p_x² + p_y² − l1² − l2²) / (2 l1 l2),   sin th2 = ± sqrt(1 − cos² th2)
    th1 = atan2(p_y, p_x) − atan2(l2 sin th2, l1 + l2 cos th2)

Two solutions inside, one on the outer circle l1 + l2 and one on the inner circle |l1 − l2| (which 4.63 forgets), none
outside, and infinitely many at the centre of axis 1 when l1 = l2.

References
----------
Notes 4.44-4.65; Siciliano et al., *Robotics*, 2.12.1.
"""

from __future__ import annotations

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._planar_fit import plane_for, solve_in_plane
from armlab.kin.ik.closed._plane import Plane
from armlab.kin.ik.closed_form import ClosedForm, Found, known_structure
from armlab.kin.ik.screws import Vector


def fits(arm: Arm) -> str | None:
    """Return a sentence why the arm is a planar 2R with its tool point as task; None when it is not."""
    plane = plane_for(arm, "planar")
    return known_structure(arm).why if plane is not None and plane.kinds == "RR" and not plane.lifts else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return both solutions, T (4, 4) in frame 0."""
    plane = _plane(arm)
    found = solve_in_plane(arm, T, plane)
    l1, l2, p = _lengths(plane, T)
    if found.q or l1 * l2 == 0.0:
        return found
    cosine = (abs(p) ** 2 - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)
    side = "farther than the stretched arm" if cosine > 1.0 else "inside the circle of the folded arm"
    return Found([], (), f"cos θ2 would be {cosine:.3f}: the target is {side}.".replace("-", "−"))


def _lengths(plane: Plane, T: Vector) -> tuple[float, float, complex]:
    one, two = plane.flats
    return abs(two.centre - one.centre), abs(plane.tool - two.centre), plane.point(T[:3, 3]) - one.centre


def _plane(arm: Arm) -> Plane:
    plane = plane_for(arm, "planar")
    assert plane is not None
    return plane


CLOSED = ClosedForm("planar_2r", "Planar 2R", 10, fits, solve)
