"""Arms whose last three axes meet: the first joints position this point, the last three turn the hand."""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.closed._placing import place
from armlab.kin.ik.closed._plane import families_of
from armlab.kin.ik.closed._turning import turn
from armlab.kin.ik.closed_form import Found
from armlab.kin.ik.screws import Screws, Vector
from armlab.kin.lines import Line, common_normal
from armlab.kin.transforms import inverse


def wrist_centre(s: Screws) -> Vector:
    """Return the point where the last three axes meet, at q = 0, in metres, frame 0."""
    fourth, fifth = Line(s.o[-3], s.z[-3]), Line(s.o[-2], s.z[-2])
    return common_normal(fourth, fifth, scale=s.scale).foot2


def solve_wrist_arm(s: Screws, G: Vector) -> Found:
    """Return all solutions of six joints for a tool pose, shape (4, 4), frame 0."""
    centre = wrist_centre(s)
    to_home = G @ inverse(s.home)
    goal = to_home[:3, :3] @ centre + to_home[:3, 3]
    found, free = [], []
    straight: set[float] = set()
    placed = place(s, centre, goal)
    for arm in placed:
        R = s.turn(0, arm.q[0]) @ s.turn(1, arm.q[1]) @ s.turn(2, arm.q[2])
        for hand in turn((s.z[3], s.z[4], s.z[5]), R.T @ to_home[:3, :3]):
            found.append(np.array([*arm.q, *hand.q]))
            free.append(arm.free)
            if hand.free:
                straight.add(round(hand.q[1], 6))
    families = families_of(free)
    if straight:
        first, last = s.z[3], s.turn(4, min(straight)) @ s.z[5]
        what = "sum" if float(first @ last) > 0.0 else "difference"
        families += (
            f"The wrist is straight: axes 4 and 6 coincide, only the {what} of q4 and q6 is fixed, and q4 may have "
            "any value.",
        )
    if found:
        return Found(found, families)
    if not placed:
        return Found([], (), "The wrist centre is out of reach of joints 1, 2 and 3.")
    return Found(
        [], (), "Joints 4, 5 and 6 cannot bring the tool to this orientation.", any(arm.free for arm in placed)
    )
