"""Six turns, axes 2, 3 and 4 parallel, axes 5 and 6 through one point: the arms of Universal Robots.

Joints 2, 3 and 4 move everything in a plane across their direction z, so they change neither z nor heights along it.
With c the point where axes 5 and 6 meet, its height seen from joint 1 is one equation for q1; the direction of z seen
from joint 6 is one for q5 and gives q6. The rest is a planar 3R with orientation. Where joint 5 makes axis 6 parallel
to z, joint 6 is free.

References
----------
Pieper 1968; Hawkins 2013, *Analytic inverse kinematics for the Universal Robots UR-5/UR-10 arms*; notes 4.22-4.23.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._plane import families_of, plane_of, solve_plane
from armlab.kin.ik.closed._turning import RIGHT, STRAIGHT
from armlab.kin.ik.closed_form import FREE_ANGLES, ClosedForm, Found, known_structure
from armlab.kin.ik.problem import REACHED_RAD
from armlab.kin.ik.screws import Screws, Vector, across, angle_about, cross, screws_of
from armlab.kin.ik.trig import Angles, sine_cosine
from armlab.kin.lines import Line, common_normal
from armlab.kin.transforms import inverse

NEARLY_STRAIGHT, UNCERTAIN = 2.0 * REACHED_RAD, 3e-3
"""Sines of the angle between axis 6 and the parallel ones: up to the first any value of joint 6 may reach the target,
though one is best; up to the second this value is not trusted unless the planar 3R confirms it, since others are within
what counts as reached, farther away the smaller the sine."""


def fits(arm: Arm) -> str | None:
    """Return a sentence why the other joints can be solved apart from a planar 3R; None when they cannot."""
    structure = known_structure(arm)
    if structure.key != "three_parallel" or arm.n != 6 or arm.task.key != "pose" or structure.free != 0:
        return None
    s = _with_plane_second(arm)
    return structure.why if s is not None and "P" not in s.kinds and _meeting(s, 4, 5) is not None else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    s = _with_plane_second(arm)
    assert s is not None
    turned = known_structure(arm).joints != (2, 3, 4)
    found = _solve(s, np.asarray(inverse(T), dtype=np.float64) if turned else T, turned)
    return replace(found, q=[q[::-1].copy() for q in found.q]) if turned else found


def _with_plane_second(arm: Arm) -> Screws | None:
    """Return the arm with parallel axes 2, 3, 4; one with 3, 4, 5 is reversed, tool to base. None without these."""
    joints = known_structure(arm).joints
    if joints == (3, 4, 5):
        return screws_of(arm).reversed()
    return screws_of(arm) if joints == (2, 3, 4) else None


def _meeting(s: Screws, i: int, j: int) -> Vector | None:
    """Return the point where two axes meet, or None when they do not."""
    normal = common_normal(Line(s.o[i], s.z[i]), Line(s.o[j], s.z[j]), scale=s.scale)
    return normal.foot1 if normal.kind == "intersecting" else None


def _solve(s: Screws, G: Vector, turned: bool) -> Found:
    meeting = _meeting(s, 4, 5)
    assert meeting is not None
    H = G @ inverse(s.home)
    inner = Screws(s.kinds[1:4], s.z[1:4], s.o[1:4], np.eye(4), s.scale)
    plane = plane_of(inner)
    first = list(_each(_first(s, plane.n, meeting, H)))
    found, free, hands, sampled = [], [], 0, False
    for q1, free1 in first:
        for q5, q6, free6, along in _hand(s, plane.n, s.turn(0, q1).T @ H[:3, :3]):
            P = inverse(s.move(0, q1)) @ H @ inverse(s.move(4, q5) @ s.move(5, q6))
            ways = solve_plane(plane, np.asarray(P), angle=True)
            hands, sampled = hands + 1, sampled or free1 or free6 or (along <= UNCERTAIN and not ways)
            for values, free_inside in ways:
                found.append(np.array([q1, values[0], values[1], values[2], q5, q6]))
                inside = frozenset(joint + 1 for joint in free_inside)
                chosen = {joint for joint, is_free in ((0, free1), (5, free6)) if is_free}
                free.append(inside | chosen)
    if turned:
        free = [frozenset(5 - joint for joint in joints) for joints in free]
    return Found(found, _families(free, turned), "" if found else _why_none(bool(first), hands > 0, turned), sampled)


def _first(s: Screws, n: Vector, meeting: Vector, H: Vector) -> Angles:
    """Return the angles of joint 1 for which the meeting point has its height along the parallel axes.

    n . E1⁻¹ H c = n . c, that is (R1 n) . (H c − o1) = n . (c − o1).
    """
    goal = H[:3, :3] @ meeting + H[:3, 3] - s.o[0]
    z = s.z[0]
    a, b = float(cross(z, n) @ goal), float((n - (n @ z) * z) @ goal)
    c = float(n @ (meeting - s.o[0])) - float(n @ z) * float(z @ goal)
    return sine_cosine(a, b, c, s.scale)


def _hand(s: Screws, n: Vector, R: Vector) -> Iterator[tuple[float, float, bool, float]]:
    """Yield q5, q6 with R R6⁻¹ R5⁻¹ n = n: R5⁻¹ n = R6 Rᵀ n.

    And whether they were chosen freely, and the sine between axis 6 and the parallel ones.
    """
    z5, z6 = s.z[4], s.z[5]
    seen = R.T @ n
    # z6 . R5⁻¹ n = z6 . seen, a sine-cosine equation in q5; the turn goes backwards.
    a, b = -float(z6 @ cross(z5, n)), float(z6 @ n - (z6 @ z5) * (z5 @ n))
    c = float(z6 @ seen - (z6 @ z5) * (z5 @ n))
    sine = across(z6, seen)
    right = abs(z5 @ n) < RIGHT and abs(z5 @ z6) < RIGHT
    for q5, free5 in _each(sine_cosine(a, b, c, 1.0, (sine if sine > STRAIGHT else 0.0) if right else None)):
        moved = s.turn(4, q5).T @ n
        along = min(across(z6, moved), sine)
        if along <= STRAIGHT:
            yield from ((q5, q6, True, along) for q6 in FREE_ANGLES)
            continue
        yield q5, angle_about(z6, seen, moved), free5, along
        if along <= NEARLY_STRAIGHT:
            yield from ((q5, q6, free5, along) for q6 in FREE_ANGLES)


def _each(angles: Angles) -> Iterator[tuple[float, bool]]:
    yield from ((value, angles.every) for value in (FREE_ANGLES if angles.every else angles.values))


def _families(free: list[frozenset[int]], turned: bool) -> tuple[str, ...]:
    last = 0 if turned else 5
    sentences = []
    if any(last in joints for joints in free):
        axes = "2, 3, 4 and 6" if not turned else "1, 3, 4 and 5"
        sentences.append(
            f"Axes {axes} are parallel: four joints share what three can do, and q{last + 1} may be chosen within what "
            "the others allow."
        )
    return (*sentences, *families_of([joints - {last} for joints in free]))


def _why_none(first: bool, hand: bool, turned: bool) -> str:
    if turned or (first and hand):
        return "The planar 3R of the parallel axes does not reach the position that the other joints require of it."
    return "The point where axes 5 and 6 meet is nearer to axis 1 than the offset of the arm allows."


CLOSED = ClosedForm("three_parallel", "Three parallel axes", 120, fits, solve)
