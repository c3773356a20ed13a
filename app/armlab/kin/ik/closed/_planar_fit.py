"""Arms to which the closed forms in a plane apply."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._plane import ALONG, Plane, found_in_plane, plane_of, solve_plane
from armlab.kin.ik.closed_form import Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of


@lru_cache(maxsize=64)
def plane_for(arm: Arm, structure: str) -> Plane | None:
    """Return the plane of an arm of this structure if the task asks for exactly what motion in it can do; else None."""
    known = known_structure(arm)
    if known.key != structure or known.free:
        return None
    plane = plane_of(screws_of(arm))
    controlled = len(plane.flats) == (3 if arm.task.rotation == "phi" else 2)
    return plane if controlled and len(plane.lifts) <= 1 and _asked(arm, plane) else None


def _asked(arm: Arm, plane: Plane) -> bool:
    """Return whether the task controls both directions of the plane and, with a lift or the angle, what these need."""
    if arm.task.rotation not in ("none", "phi"):
        return False
    if arm.task.rotation == "phi" and abs(abs(plane.n[2]) - 1.0) > ALONG:
        return False
    left = np.delete(np.eye(3), arm.task.coordinates, axis=0)
    if len(left) == 0:
        return True
    return len(left) == 1 and not plane.lifts and bool(np.linalg.norm(np.cross(left[0], plane.n)) <= ALONG)


def solve_in_plane(arm: Arm, T: Vector, plane: Plane) -> Found:
    """Return all solutions of an arm with a plane."""
    ways = solve_plane(plane, T, arm.task.rotation == "phi")
    return found_in_plane(plane, arm.n, ways, "")
