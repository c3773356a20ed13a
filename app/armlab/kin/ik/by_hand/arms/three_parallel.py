"""Six turns with axes 2, 3 and 4 parallel, and 5 and 6 through one point: the arms of Universal Robots.

Joints 2, 3 and 4 move everything in a plane across their axes, so the point where axes 5 and 6 meet stays as far beside
this plane as it is: that gives joint 1. The common turn of the three, joint 5 and joint 6 are then three turns about
axes at right angles that make the rotation, and in the plane a triangle is left.

References
----------
Pieper 1968; Hawkins 2013, *Analytic inverse kinematics for the Universal Robots UR-5/UR-10 arms*; notes 4.22-4.23.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.arms.wrist import go_back
from armlab.kin.ik.by_hand.euler import Turns, three_turns
from armlab.kin.ik.by_hand.placing import SHORT, flat, make_up, seen_from_shoulder, sense, shoulder_of, two_links
from armlab.kin.ik.by_hand.step import Line, Point, Quantity, Segment, Vector, Worked
from armlab.kin.ik.by_hand.triangle import between
from armlab.kin.ik.by_hand.turning import Pillar, Turned, pillar_of, turn_plane
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed._turning import RIGHT
from armlab.kin.ik.closed_form import closed_form_of, known_structure
from armlab.kin.ik.screws import Screws, screws_of
from armlab.kin.lines import Line as Straight
from armlab.kin.lines import common_normal
from armlab.kin.transforms import inverse


def fits(arm: Arm) -> bool:
    """Return whether axes 2, 3 and 4 are parallel, and the other neighbours at right angles."""
    form = closed_form_of(arm)
    if form is None or form[0].key != "three_parallel" or known_structure(arm).joints != (2, 3, 4):
        return False
    s = screws_of(arm)
    pillar = pillar_of(s)
    right = abs(float(s.z[3] @ s.z[4])) <= RIGHT and abs(float(s.z[4] @ s.z[5])) <= RIGHT
    if pillar is None or not right:
        return False
    return min(between(0j, flat(pillar, s.o[2]), flat(pillar, s.o[3]))[0]) > SHORT * s.scale


@lru_cache(maxsize=64)
def _meeting(s: Screws) -> Vector:
    return common_normal(Straight(s.o[4], s.z[4]), Straight(s.o[5], s.z[5]), scale=s.scale).foot1


def write(work: Work) -> None:
    """Write all steps."""
    s = work.s
    pillar = pillar_of(s)
    assert pillar is not None
    home = _meeting(s)
    centre = work.carried(home)
    name = "the point where axes 5 and 6 meet"
    go_back(
        work, home, centre, "c", "axes 5 and 6", "The point where axes 5 and 6 meet does not move when joint 6 turns"
    )
    turned = turn_plane(work, pillar, home, centre, name)
    before = s.turn(0, work.q[0])
    turns = Turns(
        (s.z[1], s.z[4], s.z[5]),
        before,
        before.T @ work.H[:3, :3],
        centre,
        (-1, 4, 5),
        r"{}^1R_6",
        r"{}^0R_1^{\mathsf T}\;{}^0R_6",
        ("the parallel axes", "axis 6"),
    )
    psi = three_turns(work, turns)
    _in_the_plane(work, pillar, turned, centre, psi)


def _in_the_plane(work: Work, pillar: Pillar, turned: Turned, centre: Vector, psi: float) -> None:
    """Find joints 2, 3 and 4 from the place of axis 4 and the common turn."""
    s = work.s
    outside = inverse(s.move(4, work.q[4]) @ s.move(5, work.q[5]))
    inside = np.asarray(inverse(s.move(0, work.q[0])) @ work.H @ outside)
    fourth = flat(pillar, inside[:3, :3] @ s.o[3] + inside[:3, 3])
    shoulder = shoulder_of(pillar, turned)
    place = np.asarray(shoulder + fourth.real * turned.ahead + fourth.imag * turned.up)
    r4, z4 = fourth.real + pillar.shoulder, fourth.imag
    values = {
        "c": Quantity(r"(\rho,\, z)", (turned.rho, turned.z)),
        "back": Quantity(r"(\Delta r,\, \Delta z)", (turned.rho - r4, turned.z - z4)),
        "p": Quantity(r"(r_4,\, z_4)", (r4, z4)),
    }
    work.add(
        "p4",
        "p_4",
        "In the plane of the arm, go back along axis 5 to axis 4",
        "go back along axis 5",
        values,
        (Line("p", "<c> - <back>"),),
        shapes=(
            Segment(place, centre, "", "given"),
            Point(place, "axis 4", "found"),
            Point(centre, "", "wanted"),
        ),
    )
    given, how = seen_from_shoulder(pillar, Quantity("r_4", r4), Quantity("z_4", z4))
    two_links(work, pillar, turned, s.o[3], fourth, given, how, "axis 4")
    title = "The sum of the three angles is known, and that of joint 4 follows"
    shapes = (Segment(place, centre, "", "given"), Point(place, "axis 4", "found"))
    make_up(work, pillar, Quantity(r"\psi", psi, "rad"), sense(s, pillar, 1), title, shapes)


WORKED = Worked("three_parallel", "Three parallel axes: a triangle in their plane", 50, fits, write)
