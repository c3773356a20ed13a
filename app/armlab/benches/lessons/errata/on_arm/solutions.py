"""Errata on inverse kinematics, drawn on an arm: where the printed solution puts the tool."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.lessons.errata.on_arm.drawn import Drawn, Floats, OnArm, Segment, Unfit
from armlab.kin.arm import Arm
from armlab.kin.errata.arms import point_elbow, point_polar

SAME = 1e-9
"""Distance, metres, up to which an arm has the direct kinematics of the notes."""

ON_AXIS = 1e-6
"""Distance from axis 1, metres, below which q1 is not determined."""


def _in_frame_0(arm: Arm, point: Floats) -> Floats:
    base = np.asarray(arm.base, dtype=np.float64)
    return np.asarray(base[:3, :3].T @ (point - base[:3, 3]))


def _agrees(arm: Arm, kinds: str, formula: str) -> bool:
    """Return whether an arm of three joints is that of the notes, with joint values as they are in its table."""
    if "".join(row.kind for row in arm.rows) != kinds or arm.convention != "standard":
        return False
    draws = np.random.default_rng(1).uniform(0.2, 0.9, (4, 3))
    points = [_in_frame_0(arm, np.asarray(arm.position(q), dtype=np.float64)) for q in draws]
    if formula == "polar":
        told = [point_polar(arm.rows[0].d, q) for q in draws]
    else:
        told = [point_elbow(arm.rows[0].d, arm.rows[1].a, arm.rows[2].a, q) for q in draws]
    return float(np.abs(np.subtract(points, told)).max()) < SAME


def _polar(arm: Arm, q: Floats) -> Drawn | Unfit:
    if not _agrees(arm, "RRP", "polar"):
        return Unfit("The formula is that of the polar arm: two turns and a slide from one point.", "polar_rrp")
    world = np.asarray(arm.position(q), dtype=np.float64)
    p = _in_frame_0(arm, world)
    if math.hypot(p[0], p[1]) < ON_AXIS:
        return Unfit("The tool is on axis 1, where the first angle is not determined. Lower the arm.")
    # The slide comes out at the back, and the arm leans away from the point: the cosine of q2 is negative.
    q3 = -float(np.linalg.norm(p - [0.0, 0.0, arm.rows[0].d]))
    q2 = math.asin((p[2] - arm.rows[0].d) / q3)
    over = math.cos(q2)
    angles = [math.atan2(p[1] / each, p[0] / each) for each in (over, q3 * over)]
    printed, right = (np.array([q1, q2, q3]) for q1 in angles)
    missed = np.asarray(arm.position(printed), dtype=np.float64)
    return Drawn(
        "The solution with the slide out at the back, q₃ < 0: in blue with the sign of q₃ in q₁, in red as printed. "
        "The line leads from the point that is asked for to where the printed one ends.",
        float(np.linalg.norm(missed - world)),
        "m",
        (Segment(world, missed, True, arrow=False, label="printed"),),
        ((printed, True), (right, False)),
    )


def _elbow(arm: Arm, q: Floats) -> Drawn | Unfit:
    if not _agrees(arm, "RRR", "elbow"):
        return Unfit("The formula is that of the elbow arm: a turning base, shoulder and elbow.", "elbow_3r")
    d1, l2, l3 = arm.rows[0].d, arm.rows[1].a, arm.rows[2].a
    world = np.asarray(arm.position(q), dtype=np.float64)
    p = _in_frame_0(arm, world)
    cosine = float((p @ p - l2**2 - l3**2) / (2.0 * l2 * l3))
    if abs(cosine) > 1.0:
        return Unfit(
            f"As printed, the cosine of the elbow would be {cosine:.2f}".replace("-", "−")
            + ": there is no such angle, although the arm is at this point. Move it nearer to the floor, or further up."
        )
    q3 = math.copysign(math.acos(cosine), q[2] or 1.0)
    out, height = math.hypot(p[0], p[1]), p[2] - d1
    q2 = math.atan2(height, out) - math.atan2(l3 * math.sin(q3), l2 + l3 * math.cos(q3))
    printed = np.array([math.atan2(p[1], p[0]), q2, q3])
    missed = np.asarray(arm.position(printed), dtype=np.float64)
    return Drawn(
        "In red the arm with the printed elbow, which looks from the floor, not from the shoulder. Its tool lies on "
        "the same ray from the shoulder, too near or too far.",
        float(np.linalg.norm(missed - world)),
        "m",
        (Segment(world, missed, True, arrow=False, label="printed"),),
        ((printed, True),),
        unseen="The tool is at half the height of the shoulder, where both triangles are the same.",
    )


ON_ARM: dict[str, OnArm] = {"4.82": _polar, "4.94": _elbow}
"""Drawings, by the id of the erratum."""
