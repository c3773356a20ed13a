"""Planar 2R: the law of cosines for joint 2, two angles for joint 1.

    cos th2 = (p_x² + p_y² − l1² − l2²) / (2 l1 l2),   sin th2 = ± sqrt(1 − cos² th2)
    th1 = atan2(p_y, p_x) − atan2(l2 sin th2, l1 + l2 cos th2)

Two solutions inside, one on the outer circle l1 + l2 and one on the inner circle |l1 − l2| (which 4.63 forgets), none
outside, and infinitely many at the centre of axis 1 when l1 = l2.

References
----------
Notes 4.44-4.65; Siciliano et al., *Robotics*, 2.12.1.
"""

from __future__ import annotations

import cmath
import math

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._planar_fit import plane_for, solve_in_plane
from armlab.kin.ik.closed._plane import Plane
from armlab.kin.ik.closed_form import ClosedForm, DerivationStep, Found, known_structure
from armlab.kin.ik.screws import Vector
from armlab.kin.ik.trig import wrap


def fits(arm: Arm) -> str | None:
    """Return a sentence why the arm is a planar 2R with its tool point as task; None when it is not."""
    plane = plane_for(arm, "planar")
    return known_structure(arm).why if plane is not None and plane.kinds == "RR" and not plane.lifts else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return both solutions, T (4, 4) in frame 0."""
    plane = _plane(arm)
    found = solve_in_plane(arm, T, plane)
    l1, l2, p = _lengths(plane, T)
    if found.q or l1 * l2 == 0.0:
        return found
    cosine = (abs(p) ** 2 - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)
    side = "farther than both links in a line" if cosine > 1.0 else "inside the circle the folded arm draws"
    return Found([], (), f"cos θ2 would be {cosine:.3f}: the target is {side}.".replace("-", "−"))


def steps(arm: Arm, T: Vector) -> tuple[DerivationStep, ...]:
    """Return the lines of the derivation at a target T (4, 4) in frame 0."""
    plane = _plane(arm)
    l1, l2, p = _lengths(plane, T)
    square = abs(p) ** 2
    cosine = (square - l1 * l1 - l2 * l2) / (2.0 * l1 * l2) if l1 * l2 > 0.0 else math.nan
    sine = math.sqrt(1.0 - cosine * cosine) if abs(cosine) <= 1.0 else math.nan
    sines = (sine, -sine)
    second = tuple(math.atan2(s, cosine) for s in sines)
    alpha = cmath.phase(p)
    betas = tuple(math.atan2(l2 * s, l1 + l2 * cosine) for s in sines)
    first = tuple(wrap(alpha - beta) if math.isfinite(beta) else math.nan for beta in betas)
    rad, m = "rad", "m"
    return (
        DerivationStep(
            "The target, seen from axis 1",
            r"p_x^2 + p_y^2",
            {"p_x": (p.real,), "p_y": (p.imag,), "p_x^2 + p_y^2": (square,)},
            {"p_x": m, "p_y": m, "p_x^2 + p_y^2": "m²"},
        ),
        DerivationStep(
            "Squaring and adding leaves the angle of the elbow",
            r"\cos\theta_2 = \frac{p_x^2 + p_y^2 - (l_1^2 + l_2^2)}{2\,l_1 l_2}",
            {"l_1": (l1,), "l_2": (l2,), r"\cos\theta_2": (cosine,)},
            {"l_1": m, "l_2": m, r"\cos\theta_2": ""},
        ),
        DerivationStep(
            "The sine has two signs: the elbow down or up",
            r"\sin\theta_2 = \pm\sqrt{1 - \cos^2\theta_2}",
            {r"\sin\theta_2": sines},
            {r"\sin\theta_2": ""},
        ),
        DerivationStep(
            "Both together give the angle",
            r"\theta_2 = \operatorname{atan2}(\sin\theta_2, \cos\theta_2)",
            {r"\theta_2": second},
            {r"\theta_2": rad},
        ),
        DerivationStep(
            "The direction of the target, and the angle between it and link 1",
            r"\alpha = \operatorname{atan2}(p_y, p_x),\quad"
            r"\beta = \operatorname{atan2}(l_2\sin\theta_2,\; l_1 + l_2\cos\theta_2)",
            {r"\alpha": (alpha,), r"\beta": betas},
            {r"\alpha": rad, r"\beta": rad},
        ),
        DerivationStep(
            "Link 1 points aside of the target", r"\theta_1 = \alpha - \beta", {r"\theta_1": first}, {r"\theta_1": rad}
        ),
        _joint_values(plane, first, second),
    )


def _joint_values(plane: Plane, first: tuple[float, ...], second: tuple[float, ...]) -> DerivationStep:
    """Return the line from geometric angles to joint values: directions of the axes and offsets of the table."""
    one, two = plane.flats
    zero1 = cmath.phase(two.centre - one.centre)
    zero2 = cmath.phase((plane.tool - two.centre) / (two.centre - one.centre)) if two.centre != one.centre else 0.0
    return DerivationStep(
        "Joint values count from where the table has its zero",
        r"q_i = \pm(\theta_i - \theta_{i0})",
        {
            r"\theta_{10}": (zero1,),
            r"\theta_{20}": (zero2,),
            "q_1": tuple(wrap(one.way.real * (theta - zero1)) for theta in first),
            "q_2": tuple(wrap(two.way.real * (theta - zero2)) for theta in second),
        },
        dict.fromkeys((r"\theta_{10}", r"\theta_{20}", "q_1", "q_2"), "rad"),
    )


def _lengths(plane: Plane, T: Vector) -> tuple[float, float, complex]:
    one, two = plane.flats
    return abs(two.centre - one.centre), abs(plane.tool - two.centre), plane.point(T[:3, 3]) - one.centre


def _plane(arm: Arm) -> Plane:
    plane = plane_for(arm, "planar")
    assert plane is not None
    return plane


CLOSED = ClosedForm("planar_2r", "Planar 2R", 10, fits, solve, steps)
