"""Polar RRP: two angles and a length with both signs.

    q3 = ± gamma,  gamma² = p_x² + p_y² + (p_z − d1)²,   sin q2 = (p_z − d1) / q3,   cos q2 = ± sqrt(1 − sin² q2)
    q1 = atan2(p_y / (q3 cos q2), p_x / (q3 cos q2))

q2 is the elevation, not the joint variable of the table; q3 in the last line is missing in 4.82, where it matters for
two of the four solutions. With p_x = p_y = 0 joint 1 is free, with gamma = 0 joint 2 as well.

References
----------
Notes 4.66-4.82.
"""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._place import places, solve_place
from armlab.kin.ik.closed_form import ClosedForm, DerivationStep, Found, known_structure
from armlab.kin.ik.screws import Vector, cross, screws_of
from armlab.kin.ik.trig import wrap
from armlab.kin.lines import Line, common_normal


def fits(arm: Arm) -> str | None:
    """Return a sentence why the joint values are two angles and a length; None when they are not."""
    return known_structure(arm).why if places(arm) and known_structure(arm).key == "polar" else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_place(arm, T, "The target is nearer to the shoulder than the slide passes by it.")


def steps(arm: Arm, T: Vector) -> tuple[DerivationStep, ...]:
    """Return the lines of the derivation; none for an arm whose slide does not pass through the shoulder."""
    s = screws_of(arm)
    shoulder = common_normal(Line(s.o[0], s.z[0]), Line(s.o[1], s.z[1]), scale=s.scale).foot1
    rest = s.home[:3, 3] - shoulder
    if float(np.linalg.norm(cross(rest, s.z[2]))) > 1e-9 * s.scale:
        return ()
    p, up = T[:3, 3] - shoulder, s.z[0]
    # The directions from which the notes count: x along frame 0's where axis 1 allows.
    x = np.eye(3)[0] if abs(up[0]) < 0.9 else np.eye(3)[1]
    x = x - (x @ up) * up
    x = x / np.linalg.norm(x)
    px, py, pz = float(p @ x), float(p @ cross(up, x)), float(p @ up)
    gamma = math.sqrt(px * px + py * py + pz * pz)
    rho = math.hypot(px, py)
    lengths = (gamma, gamma, -gamma, -gamma)
    sines = tuple(pz / q3 if gamma > 0.0 else math.nan for q3 in lengths)
    cosines = tuple(sign * rho / gamma if gamma > 0.0 else math.nan for sign in (1.0, -1.0, 1.0, -1.0))
    second = tuple(math.atan2(sine, cosine) for sine, cosine in zip(sines, cosines, strict=True))
    first = tuple(
        math.atan2(py / (q3 * c), px / (q3 * c)) if gamma > 0.0 and rho > 1e-10 * s.scale else math.nan
        for q3, c in zip(lengths, cosines, strict=True)
    )
    offset = float(rest @ s.z[2])
    return (
        DerivationStep(
            "The target, seen from the shoulder",
            r"p_x,\; p_y,\; p_z - d_1",
            {"p_x": (px,), "p_y": (py,), "p_z - d_1": (pz,)},
            dict.fromkeys(("p_x", "p_y", "p_z - d_1"), "m"),
        ),
        DerivationStep(
            "Squaring and adding leaves the length, with both signs",
            r"q_3 = \pm\gamma,\quad \gamma = \sqrt{p_x^2 + p_y^2 + (p_z - d_1)^2}",
            {"q_3": lengths},
            {"q_3": "m"},
        ),
        DerivationStep(
            "The height gives the sine of the elevation",
            r"\sin q_2 = \frac{p_z - d_1}{q_3}",
            {r"\sin q_2": sines},
            {r"\sin q_2": ""},
        ),
        DerivationStep(
            "The cosine has two signs",
            r"\cos q_2 = \pm\sqrt{1 - \sin^2 q_2}",
            {r"\cos q_2": cosines},
            {r"\cos q_2": ""},
        ),
        DerivationStep(
            "Both together give the elevation",
            r"q_2 = \operatorname{atan2}(\sin q_2, \cos q_2)",
            {"q_2": second},
            {"q_2": "rad"},
        ),
        DerivationStep(
            "The plan gives the direction; the sign of the length counts",
            r"q_1 = \operatorname{atan2}\left(\frac{p_y}{q_3\cos q_2}, \frac{p_x}{q_3\cos q_2}\right)",
            {"q_1": tuple(wrap(value) if math.isfinite(value) else value for value in first)},
            {"q_1": "rad"},
        ),
        DerivationStep(
            "The joint variable of the slide counts from where the table has its zero",
            r"q_3^{\text{table}} = q_3 - q_{30}",
            {"q_{30}": (offset,), r"q_3^{\text{table}}": tuple(value - offset for value in lengths)},
            {"q_{30}": "m", r"q_3^{\text{table}}": "m"},
        ),
    )


CLOSED = ClosedForm("polar", "Polar RRP", 60, fits, solve, steps)
