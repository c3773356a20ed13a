"""Six joints with a spherical wrist: the wrist centre is placed by joints 1 to 3, then joints 4 to 6 turn the hand.

The position of the wrist centre, p − d6 z6 in the usual table, does not depend on the wrist. Any three joints before it
will do: the shoulder and elbow offsets of the PUMA, the slide of the Stanford and the Unimate. With axes 4 and 6 in one
line only the sum or difference of q4 and q6 is fixed.

References
----------
Pieper 1968; notes, section 4.3.2; Siciliano et al., *Robotics*, 2.12.3-2.12.5.
"""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed._turning import RIGHT
from armlab.kin.ik.closed._wrist import solve_wrist_arm, wrist_centre
from armlab.kin.ik.closed_form import ClosedForm, DerivationStep, Found, known_structure
from armlab.kin.ik.screws import Vector, screws_of
from armlab.kin.transforms import inverse


def fits(arm: Arm) -> str | None:
    """Return a sentence why position and orientation can be solved separately; None when they cannot."""
    structure = known_structure(arm)
    fitting = structure.key == "spherical_wrist" and arm.n == 6 and arm.task.key == "pose" and structure.free == 0
    return structure.why if fitting else None


def solve(arm: Arm, T: Vector) -> Found:
    """Return all solutions, T (4, 4) in frame 0."""
    return solve_wrist_arm(screws_of(arm), T)


def steps(arm: Arm, T: Vector) -> tuple[DerivationStep, ...]:
    """Return the lines of the derivation; none where neighbouring wrist axes are not at a right angle.

    Columns of numbers belong to the placements of the wrist centre, in the order of `solve`; the lines of the wrist
    have both signs of theta 5 for each.
    """
    s = screws_of(arm)
    if abs(s.z[3] @ s.z[4]) > RIGHT or abs(s.z[4] @ s.z[5]) > RIGHT:
        return ()
    centre = wrist_centre(s)
    to_home = T @ inverse(s.home)
    goal = to_home[:3, :3] @ centre + to_home[:3, 3]
    whole = solve_wrist_arm(s, T).q
    placed = np.array(list(dict.fromkeys(tuple(np.round(q[:3], 9)) for q in whole))).reshape(-1, 3)
    unit = ["rad" if kind == "R" else "m" for kind in s.kinds[:3]]
    wrist = tuple(float(q[4]) for q in whole)
    sines = tuple(float(np.linalg.norm(np.cross(*_ends(arm, T, q)))) for q in placed)
    cosines = tuple(float(np.dot(*_ends(arm, T, q))) for q in placed)
    return (
        DerivationStep(
            "The wrist centre does not depend on the wrist: go back from the tool along the hand",
            r"p_w = p - R\,p_{\text{hand}}",
            {"p_{w,x}": (float(goal[0]),), "p_{w,y}": (float(goal[1]),), "p_{w,z}": (float(goal[2]),)},
            dict.fromkeys(("p_{w,x}", "p_{w,y}", "p_{w,z}"), "m"),
        ),
        DerivationStep(
            "Joints 1, 2 and 3 place it, in up to four ways",
            r"p_w = f(q_1, q_2, q_3)",
            {f"q_{i + 1}": tuple(float(value) for value in placed[:, i]) for i in range(3)},
            {f"q_{i + 1}": unit[i] for i in range(3)},
        ),
        DerivationStep(
            "What rotation is left is the wrist's; its last axis seen from its first gives theta 5",
            r"{}^3R_6 = {}^0R_3^{\mathsf T}\,R,\quad \cos\theta_5 = z_3\cdot z_6,\quad "
            r"\sin\theta_5 = \pm\lVert z_3\times z_6\rVert",
            {
                r"\cos\theta_5": cosines,
                r"\sin\theta_5": tuple(sign * sine for sine in sines for sign in (1.0, -1.0)),
                r"\theta_5": tuple(
                    math.atan2(sign * sine, cosine)
                    for sine, cosine in zip(sines, cosines, strict=True)
                    for sign in (1.0, -1.0)
                ),
            },
            {r"\cos\theta_5": "", r"\sin\theta_5": "", r"\theta_5": "rad"},
        ),
        DerivationStep(
            "Each sign leaves one theta 4 and one theta 6; in joint values, offsets taken off",
            r"q_4,\; q_5,\; q_6",
            {"q_4": tuple(float(q[3]) for q in whole), "q_5": wrist, "q_6": tuple(float(q[5]) for q in whole)},
            dict.fromkeys(("q_4", "q_5", "q_6"), "rad"),
        ),
    )


def _ends(arm: Arm, T: Vector, q: Vector) -> tuple[Vector, Vector]:
    """Return the directions of axes 4 and 6 in frame 0, after joints 1 to 3 and in the wanted pose."""
    s = screws_of(arm)
    R = s.turn(0, q[0]) @ s.turn(1, q[1]) @ s.turn(2, q[2])
    return np.asarray(R @ s.z[3]), np.asarray(T[:3, :3] @ s.home[:3, :3].T @ s.z[5])


CLOSED = ClosedForm("spherical_wrist", "Spherical wrist", 100, fits, solve, steps)
