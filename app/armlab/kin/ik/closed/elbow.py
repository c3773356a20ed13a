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

import math

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._place import places, solve_place
from armlab.kin.ik.closed_form import ClosedForm, DerivationStep, Found, known_structure
from armlab.kin.ik.screws import Screws, Vector, cross, screws_of
from armlab.kin.ik.trig import two_equations
from armlab.kin.lines import Line, common_normal


def fits(arm: Arm) -> str | None:
    """Return a sentence why joint 1 turns the plane of a planar 2R; None when it does not."""
    return known_structure(arm).why if places(arm) and known_structure(arm).key == "elbow" else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_place(arm, T, "The target is out of reach of upper arm and forearm from the shoulder.")


def steps(arm: Arm, T: Vector) -> tuple[DerivationStep, ...]:
    """Return the lines of the derivation; none for an arm with offsets, which is not in the notes."""
    lengths = _lengths(screws_of(arm))
    if lengths is None:
        return ()
    shoulder, x, L2, L3 = lengths
    s = screws_of(arm)
    p, up = T[:3, 3] - shoulder, s.z[0]
    px, py, pz = float(p @ x), float(p @ cross(up, x)), float(p @ up)
    cosine = (px * px + py * py + pz * pz - L2 * L2 - L3 * L3) / (2.0 * L2 * L3)
    sine = math.sqrt(1.0 - cosine * cosine) if abs(cosine) <= 1.0 else math.nan
    on_axis = math.hypot(px, py) <= 1e-10 * s.scale
    first = (math.nan, math.nan) if on_axis else (math.atan2(py, px), math.atan2(-py, -px))
    pairs = [(theta, sign * sine) for theta in first for sign in (1.0, -1.0)]
    second = tuple(_second(theta, s3, cosine, px, py, pz, L2, L3) for theta, s3 in pairs)
    rad, m = "rad", "m"
    return (
        DerivationStep(
            "The target, seen from the shoulder",
            r"p_x,\; p_y,\; p_z - d_1",
            {"p_x": (px,), "p_y": (py,), "p_z - d_1": (pz,)},
            dict.fromkeys(("p_x", "p_y", "p_z - d_1"), m),
        ),
        DerivationStep(
            "Squaring and adding leaves the angle of the elbow",
            r"\cos\theta_3 = \frac{p_x^2 + p_y^2 + (p_z - d_1)^2 - L_2^2 - L_3^2}{2 L_2 L_3}",
            {"L_2": (L2,), "L_3": (L3,), r"\cos\theta_3": (cosine,)},
            {"L_2": m, "L_3": m, r"\cos\theta_3": ""},
        ),
        DerivationStep(
            "The sine has two signs",
            r"\theta_3 = \operatorname{atan2}\left(\pm\sqrt{1 - \cos^2\theta_3}, \cos\theta_3\right)",
            {r"\sin\theta_3": (sine, -sine), r"\theta_3": (math.atan2(sine, cosine), math.atan2(-sine, cosine))},
            {r"\sin\theta_3": "", r"\theta_3": rad},
        ),
        DerivationStep(
            "The arm turns its front or its back to the target",
            r"\theta_1 = \operatorname{atan2}(\pm p_y, \pm p_x)",
            {r"\theta_1": first},
            {r"\theta_1": rad},
        ),
        DerivationStep(
            "In the plane of the arm two equations remain for each pair, linear in cosine and sine of joint 2",
            r"\begin{aligned}\cos\theta_1\,p_x + \sin\theta_1\,p_y &= (L_2 + L_3 c_3)\,c_2 - L_3 s_3\,s_2\\"
            r"p_z - d_1 &= L_3 s_3\,c_2 + (L_2 + L_3 c_3)\,s_2\end{aligned}",
            {
                r"\cos\theta_1\,p_x + \sin\theta_1\,p_y": tuple(
                    math.cos(theta) * px + math.sin(theta) * py for theta, _ in pairs
                ),
                "L_2 + L_3 c_3": (L2 + L3 * cosine,),
                "L_3 s_3": tuple(L3 * s3 for _, s3 in pairs),
            },
            {r"\cos\theta_1\,p_x + \sin\theta_1\,p_y": m, "L_2 + L_3 c_3": m, "L_3 s_3": m},
        ),
        DerivationStep(
            "Their determinant is the square of the distance from the shoulder",
            r"\theta_2 = \operatorname{atan2}(s_2, c_2)",
            {r"\theta_2": second},
            {r"\theta_2": rad},
        ),
    )


def _second(theta: float, s3: float, c3: float, px: float, py: float, pz: float, L2: float, L3: float) -> float:
    """Return theta 2 from the two equations; nan where they do not determine it or have no solution."""
    if not (math.isfinite(theta) and math.isfinite(s3)):
        return math.nan
    ahead = math.cos(theta) * px + math.sin(theta) * py
    both = two_equations((-L3 * s3, L2 + L3 * c3, ahead), (L2 + L3 * c3, L3 * s3, pz), L2 + L3)
    return both.values[0] if both.values else math.nan


def _lengths(s: Screws) -> tuple[Vector, Vector, float, float] | None:
    """Return the shoulder, the direction of theta 1 = 0, and both lengths; None for an arm with offsets."""
    shoulder_normal = common_normal(Line(s.o[0], s.z[0]), Line(s.o[1], s.z[1]), scale=s.scale)
    shoulder, across = shoulder_normal.foot2, s.z[1]
    elbow, hand = s.o[2] - shoulder, s.home[:3, 3] - s.o[2]
    aside = float(hand @ across) + float(elbow @ across)
    upper, fore = elbow - (elbow @ across) * across, hand - (hand @ across) * across
    if shoulder_normal.a > 0.0 or abs(aside) > 1e-9 * s.scale:
        return None
    up = s.z[0]
    x = np.eye(3)[0] if abs(up[0]) < 0.9 else np.eye(3)[1]
    x = x - (x @ up) * up
    L2, L3 = float(np.linalg.norm(upper)), float(np.linalg.norm(fore))
    return (shoulder, x / np.linalg.norm(x), L2, L3) if L2 * L3 > 0.0 else None


CLOSED = ClosedForm("elbow", "Elbow 3R", 70, fits, solve, steps)
