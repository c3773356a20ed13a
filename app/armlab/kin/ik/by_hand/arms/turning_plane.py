"""Four or five turns for a place: joint 1 turns the plane of three links, and a fifth joint rolls the hand.

The place of the tool leaves the direction of the hand free, and its roll: those of the wanted pose are taken, as near
as the arm can turn its hand to it.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.placing import SHORT, flat, make_up, seen_from_shoulder, sense, shoulder_of, two_links
from armlab.kin.ik.by_hand.step import Arc, Branch, Circle, Line, Point, Quantity, Segment, Vector, Worked
from armlab.kin.ik.by_hand.triangle import between
from armlab.kin.ik.by_hand.turning import MARK, Pillar, Turned, pillar_of, turn_plane
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed_form import known_structure
from armlab.kin.ik.screws import Screws, across, angle_about, cross, screws_of
from armlab.kin.ik.trig import wrap

ASKEW = 1e-6
"""Length of the part of a wanted direction in the plane below which it says nothing of the angle there."""


def fits(arm: Arm) -> bool:
    """Return whether only the place counts, joint 1 turns the plane of three links, and a roll leaves the tool."""
    position = arm.task.position == "xyz" and arm.task.rotation == "none"
    if known_structure(arm).key != "turning_plane" or not position:
        return False
    s = screws_of(arm)
    pillar = pillar_of(s)
    if pillar is None or (arm.n == 5 and across(s.z[4], s.home[:3, 3] - s.o[4]) > SHORT * s.scale):
        return False
    fourth = flat(pillar, s.o[3])
    lengths = (*between(0j, flat(pillar, s.o[2]), fourth)[0], abs(flat(pillar, s.home[:3, 3]) - fourth))
    return min(lengths) > SHORT * s.scale


def write(work: Work) -> None:
    """Write all steps."""
    s = work.s
    pillar = pillar_of(s)
    assert pillar is not None
    turned = turn_plane(work, pillar, s.home[:3, 3], work.T[:3, 3], "the tool point")
    total = _direction(work, pillar, turned)
    hand = flat(pillar, s.home[:3, 3]) - flat(pillar, s.o[3])
    end = complex(turned.rho - pillar.shoulder, turned.z)
    fourth = end - cmath.exp(1j * total) * hand
    given, how = _back(work, pillar, turned, end, fourth, total, hand)
    two_links(work, pillar, turned, s.o[3], fourth, given, how, "axis 4")
    title = "The orientation is the sum of the angles, from which that of joint 4 follows"
    turn = Quantity(r"(\varphi - \varphi_0)", wrap(total), "rad")
    make_up(work, pillar, turn, 1.0, title, (Point(work.T[:3, 3], "", "wanted"),))
    if work.arm.n == 5:
        _roll(work)


def _pointing(s: Screws, pillar: Pillar) -> Vector:
    """Return the direction of the hand at q = 0, in frame 0: of axis 5, or from axis 4 to the tool."""
    if len(s.kinds) == 5:
        return np.asarray(s.z[4])
    hand = flat(pillar, s.home[:3, 3]) - flat(pillar, s.o[3])
    return np.asarray((hand.real * pillar.ahead + hand.imag * pillar.up) / abs(hand))


def _direction(work: Work, pillar: Pillar, turned: Turned) -> float:
    """Return the turn of the hand in the plane from where it is at q = 0; a step chooses it."""
    s = work.s
    rest = _pointing(s, pillar)
    zero = math.atan2(float(rest @ pillar.up), float(rest @ pillar.ahead))
    wanted = work.H[:3, :3] @ rest
    seen = complex(float(wanted @ turned.ahead), float(wanted @ turned.up))
    free = abs(seen) <= ASKEW
    present = zero + sum(sense(s, pillar, i) * float(work.near[i]) for i in (1, 2, 3))
    phi = wrap(present if free else cmath.phase(seen))
    note = "Only the position counts for this task: the direction of the last link is free. "
    note += "The present one is kept." if free else "That of the wanted pose is used, seen in the plane of the arm."
    tool = work.T[:3, 3]
    radius = MARK * s.scale
    way = math.cos(phi) * turned.ahead + math.sin(phi) * turned.up
    work.add(
        "phi",
        r"\varphi",
        "The direction of the last link in the plane of the arm is chosen",
        "a choice",
        {"phi": Quantity(r"\varphi", phi, "rad")},
        (),
        case="any",
        note=note,
        shapes=(
            Segment(tool, np.asarray(tool + 2.0 * radius * turned.ahead), "", "helper"),
            Segment(tool, np.asarray(tool + 2.0 * radius * way), "", "wanted"),
            Arc(tool, radius * turned.ahead, cross(turned.ahead, turned.up), phi, "phi"),
            Point(tool, "", "wanted"),
        ),
    )
    return phi - zero


def _back(
    work: Work, pillar: Pillar, turned: Turned, end: complex, fourth: complex, total: float, hand: complex
) -> tuple[dict[str, Quantity], tuple[str, str, str]]:
    """Write the step to axis 4, and return how its place is given from the shoulder."""
    shoulder = shoulder_of(pillar, turned)
    place = np.asarray(shoulder + fourth.real * turned.ahead + fourth.imag * turned.up)
    tool = np.asarray(shoulder + end.real * turned.ahead + end.imag * turned.up)
    r4, z4 = fourth.real + pillar.shoulder, fourth.imag
    values = {
        "p": Quantity(r"(\rho,\, z)", (turned.rho, turned.z)),
        "L4": Quantity("L_4", abs(hand)),
        "phi": Quantity(r"\varphi", wrap(total + cmath.phase(hand)), "rad"),
        "c": Quantity("(r_4,\\, z_4)", (r4, z4)),
    }
    work.add(
        "p4",
        "p_4",
        "Go back from the tool along the last link: axis 4 lies there",
        "go back along the last link",
        values,
        (Line("c", r"<p> - <L4>\,(\cos<phi>,\, \sin<phi>)"),),
        shapes=(
            Segment(place, tool, "L4", "given"),
            Circle(tool, cross(turned.ahead, turned.up), abs(hand)),
            Point(place, "axis 4", "found"),
            Point(tool, "", "wanted"),
        ),
    )
    return seen_from_shoulder(pillar, Quantity("r_4", r4), Quantity("z_4", z4))


def _roll(work: Work) -> None:
    """Write the step of joint 5: the roll that turns the hand as near to the wanted pose as can be."""
    s = work.s
    axis, side = s.z[4], s.z[3]
    before = np.eye(3)
    for i in range(4):
        before = before @ s.turn(i, work.q[i])
    wanted = before.T @ work.H[:3, :3] @ side
    free = across(axis, wanted) <= ASKEW
    value = work.kept(4) if free else angle_about(axis, side, wanted)
    note = "The tool point lies on axis 5, so the roll is free. "
    note += "The present one is kept." if free else "The one nearest to the wanted pose is used."
    tool, radius = work.T[:3, 3], MARK * s.scale
    work.add(
        "q5",
        "q_5",
        "Joint 5 rotates the last link about its own direction",
        "atan2 of two lengths",
        {"q": Quantity("q_5", value, "rad")},
        (),
        index=4,
        branches=(Branch("as it is" if free else "", value),),
        case="any",
        note=note,
        shapes=(Arc(tool, radius * (before @ side), before @ axis, value, "q"), Point(tool, "", "wanted")),
    )


WORKED = Worked("turning_plane", "Joint 1 turns a plane, and a triangle lies in it", 60, fits, write)
