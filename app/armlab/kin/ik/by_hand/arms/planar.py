"""Arms that move in a plane, with a lift or without: two joints bring a point to its place, a third turns the hand.

References
----------
Notes 4.44-4.65, corrected; Siciliano et al., *Robotics*, 2.12.1.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.placing import SHORT, summed
from armlab.kin.ik.by_hand.step import Arc, Branch, Circle, Line, Point, Quantity, Segment, Vector, Worked
from armlab.kin.ik.by_hand.stretch import Stroke, stretch
from armlab.kin.ik.by_hand.triangle import Joint, Links, between, reach
from armlab.kin.ik.by_hand.turning import MARK
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.closed._plane import ALONG, Plane, heading, plane_of
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.screws import screws_of
from armlab.kin.ik.trig import wrap

FORMS = ("planar_2r", "planar", "scara", "cylindrical")
"""Closed forms of arms in a plane."""


def fits(arm: Arm) -> bool:
    """Return whether two links, or a turn and a slide, and perhaps a turn of the hand move the arm in a plane."""
    form = closed_form_of(arm)
    if form is None or form[0].key not in FORMS:
        return False
    plane = plane_of(screws_of(arm))
    if plane.kinds in ("RP", "RPR"):
        return True
    if plane.kinds not in ("RR", "RRR"):
        return False
    return min(between(*_corners(plane))[0]) > SHORT * plane.scale


def _corners(plane: Plane) -> tuple[complex, complex, complex]:
    """Return axis 1, axis 2 and what they place, at q = 0, in the plane."""
    first, second, *third = plane.flats
    return first.centre, second.centre, third[0].centre if third else plane.tool


def write(work: Work) -> None:
    """Write all steps."""
    plane = plane_of(work.s)
    height = float(plane.n @ (work.T[:3, 3] - plane.home[:3, 3]))
    for joint, sense in plane.lifts:
        _lift(work, plane, joint, sense, height)
    if not plane.lifts and len(work.arm.task.coordinates) == 3 and abs(height) > REACHED_M:
        _beside(work, plane, height)
    at = work.T[:3, 3]
    angle = heading(plane, work.T) if len(plane.flats) == 3 else math.nan
    name = "the tool point"
    goal = plane.point(at)
    if len(plane.flats) == 3:
        goal, name = _back(work, plane, goal, angle, at)
    first, second = plane.flats[:2]
    floor = first.centre.real * plane.u + first.centre.imag * plane.v
    origin = np.asarray(floor + float(plane.n @ at) * plane.n)
    end = goal - first.centre
    given = {"x": Quantity("x", end.real), "y": Quantity("y", end.imag)}
    how = ("<x>", "<y>", r"\sqrt{<x>^2 + <y>^2}")
    axis = f"axis {first.joint + 1}"
    if second.turns:
        lengths, zero, bend = between(*_corners(plane))
        turning = (Joint(first.joint, first.way.real, zero), Joint(second.joint, second.way.real, bend))
        links = Links(origin, plane.u, plane.v, lengths, turning, ("L_1", "L_2", name, axis))
        reach(work, links, end, given, how)
    else:
        what = _corners(plane)[2]
        seen = (what - first.centre) * second.way.conjugate()
        turn = Joint(first.joint, first.way.real, cmath.phase(second.way))
        stroke = Stroke(origin, plane.u, plane.v, turn, second.joint, seen.imag, seen.real, (name, axis))
        stretch(work, stroke, end, given, how)
    if len(plane.flats) == 3:
        _hand(work, plane, angle, at)


def _lift(work: Work, plane: Plane, joint: int, sense: float, height: float) -> None:
    n, value = joint + 1, sense * height
    top = np.asarray(work.T[:3, 3])
    # A plane may be seen from below, as that of an arm that hangs: heights are still those of frame 0.
    axis = int(np.argmax(np.abs(plane.n)))
    upwards = math.copysign(1.0, plane.n[axis])
    letter, up = ("xyz"[axis], upwards * plane.n) if _along_an_axis(plane.n) else ("n", plane.n)
    rises = sense * float(up @ plane.n) > 0.0
    work.add(
        f"q{n}",
        f"q_{n}",
        "The height is one joint's alone",
        "read off",
        {
            "z": Quantity(f"p_{letter}", float(up @ work.T[:3, 3])),
            "zero": Quantity(f"p_{{{letter},0}}", float(up @ plane.home[:3, 3])),
            "q": Quantity(f"q_{n}", value),
        },
        (Line("q", "<z> - <zero>" if rises else "<zero> - <z>"),),
        index=joint,
        branches=(Branch("", value),),
        shapes=(Segment(top - height * plane.n, top, "q", "found"), Point(top, "", "wanted")),
    )


def _beside(work: Work, plane: Plane, height: float) -> None:
    """Write the step that has no value: without a lift the tool never leaves its plane."""
    at = np.asarray(work.T[:3, 3])
    work.add(
        "h",
        "h",
        "No joint moves the tool out of its plane, so the target must lie in it",
        "distance from the plane",
        {"h": Quantity("h", abs(height))},
        (),
        case="none",
        note="Out of reach: the target is {gap} beside the plane in which the arm moves.",
        gap=abs(height),
        shapes=(Segment(at - height * plane.n, at, "h", "found"), Point(at, "", "wanted")),
    )


def _along_an_axis(way: Vector) -> bool:
    """Return whether a direction is that of an axis of frame 0, or its opposite."""
    return float(np.abs(way).max()) > 1.0 - ALONG


def _pair(plane: Plane, letter: str) -> str:
    """Return the LaTeX of both coordinates of a point of the plane, seen from above or from below."""
    return rf"({letter}_x,\, {letter}_y)" if plane.n[2] > 0.0 else rf"({letter}_x,\, -{letter}_y)"


def _back(work: Work, plane: Plane, goal: complex, angle: float, at: Vector) -> tuple[complex, str]:
    """Return the place that the axis of the last joint must have, and its name; a step where the hand has a length."""
    third = plane.flats[2]
    name, hand = f"axis {third.joint + 1}", plane.tool - third.centre
    if abs(hand) <= work.tiny:
        return goal, name
    centre = goal - cmath.exp(1j * angle) * hand
    turned, length = cmath.phase(hand), abs(hand)
    values = {
        "p": Quantity(_pair(plane, "p"), (goal.real, goal.imag)),
        "L3": Quantity("L_3", length),
        "phi": Quantity(r"\varphi", wrap(angle + turned), "rad"),
        "c": Quantity(_pair(plane, "c"), (centre.real, centre.imag)),
    }
    place = np.asarray(at + (centre - goal).real * plane.u + (centre - goal).imag * plane.v)
    work.add(
        "c",
        "c",
        f"The wanted direction of the last link places {name}: go back from the tool by its length",
        "go back along the last link",
        values,
        (Line("c", r"<p> - <L3>\,(\cos<phi>,\, \sin<phi>)"),),
        shapes=(
            Segment(place, at, "L3", "given"),
            Circle(at, plane.n, length),
            Point(place, name, "found"),
            Point(at, "", "wanted"),
        ),
    )
    return centre, name


def _hand(work: Work, plane: Plane, angle: float, at: Vector) -> None:
    """Write the step of the last turn: what the others leave of the wanted one."""
    third = plane.flats[2]
    turning = [flat for flat in plane.flats[:2] if flat.turns]
    hand = cmath.exp(1j * angle) * (plane.tool - third.centre)
    axis = np.asarray(at - hand.real * plane.u - hand.imag * plane.v)
    n, way = third.joint + 1, third.way.real
    value = wrap(way * (angle - sum(flat.way.real * work.q[flat.joint] for flat in turning)))
    values = {"phi": Quantity(r"\varphi_0", angle, "rad"), "q": Quantity(f"q_{n}", value, "rad")}
    terms = [(way, "phi")]
    for flat in turning:
        values[f"q{flat.joint + 1}"] = Quantity(f"q_{flat.joint + 1}", work.q[flat.joint], "rad")
        terms.append((-way * flat.way.real, f"q{flat.joint + 1}"))
    work.add(
        f"q{n}",
        f"q_{n}",
        "The orientation is the sum of the angles, from which the last one follows",
        "sum of the angles",
        values,
        (Line("q", summed(terms)),),
        index=third.joint,
        branches=(Branch("", value),),
        shapes=(
            Segment(axis, at, "", "given"),
            Arc(at, MARK * work.s.scale * plane.u, plane.n, angle, "phi", "wanted"),
            Point(at, "", "wanted"),
        ),
    )


WORKED = Worked("planar", "An arm in a plane: a triangle", 20, fits, write)
