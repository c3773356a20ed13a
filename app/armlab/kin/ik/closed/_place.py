"""Common part of the closed forms of three-joint arms that position the tool point."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._placing import place
from armlab.kin.ik.closed._plane import families_of
from armlab.kin.ik.closed_form import Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of


def places(arm: Arm) -> bool:
    """Return whether a three-joint arm has the position of its tool point as task, and can control it."""
    return arm.n == 3 and arm.task.position == "xyz" and arm.task.rotation == "none" and known_structure(arm).free == 0


def solve_place(arm: Arm, T: Vector, none: str = "") -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    s = screws_of(arm)
    placed = place(s, s.home[:3, 3], T[:3, 3])
    found = [np.array(one.q) for one in placed]
    return Found(found, families_of([one.free for one in placed]), "" if found else none)
