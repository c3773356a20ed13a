"""Errata on velocities, drawn on an arm: the last column of J, angle rates, and the error under joint control."""

from __future__ import annotations

import numpy as np

from armlab.benches.lessons.errata.on_arm.drawn import Drawn, Floats, OnArm, Unfit, arrows
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx, rotation_about

TURNING, SLIDING = 1.0, 0.3
"""Speeds of joints that turn, rad/s, and that slide, m/s."""

RATES = np.array([0.2, -0.4, 0.7])
"""Rates of roll, pitch and yaw, rad/s: those with which the erratum was checked."""

OFF, GAIN = 0.2, 3.0
"""Error of a joint that turns, rad, of which one that slides has the same part as of the speed; and gain, 1/s."""


def _last_column(arm: Arm, q: Floats) -> Drawn | Unfit:
    if not arm.rows[-1].revolute:
        return Unfit(
            "The last joint of this arm slides: its column is z, and no vector to the tool is needed.", "planar_2r"
        )
    point = np.asarray(arm.position(q), dtype=np.float64)
    speeds = np.where(arm.revolute, TURNING, SLIDING)
    J = np.asarray(arm.jacobian(q), dtype=np.float64)[:3]
    right, last = J @ speeds, J[:, -1] * speeds[-1]
    return Drawn(
        f"All joints move, those that turn with {TURNING:g} rad/s. The velocity of the tool is blue; red is that "
        f"without the part of joint {arm.n}, whose vector is said to be 0.",
        float(np.linalg.norm(last)),
        "m/s",
        arrows(point, (right - last, right), arm, ("printed", "v")),
        unseen=f"The tool lies on the axis of joint {arm.n}, which does not move it: any vector along it will do.",
    )


def _angle_rates(arm: Arm, q: Floats) -> Drawn | Unfit:
    T = np.asarray(arm.fk(q), dtype=np.float64)
    (yaw, pitch, _), _ = euler_zyx(T[:3, :3])
    Rz, Ry = rotation_about("z", yaw), rotation_about("y", pitch)
    right = np.column_stack([(Rz @ Ry)[:, 0], Rz[:, 1], [0.0, 0.0, 1.0]]) @ RATES
    printed = T[:3, :3] @ RATES
    return Drawn(
        "The tool's roll, pitch and yaw change by 0.2, −0.4 and 0.7 rad/s. ω from the axes of the three turns in blue, "
        "and in red from the rotation matrix in their place.",
        float(np.linalg.norm(printed - right)),
        "rad/s",
        arrows(T[:3, 3], (printed, right), arm, ("printed", "ω")),
        unseen="In this orientation both are the same.",
    )


def _error_rate(arm: Arm, q: Floats) -> Drawn | Unfit:
    signs = (-1.0) ** np.arange(arm.n)
    usual = np.where(arm.revolute, TURNING, SLIDING)
    e, rate = OFF * signs * usual, 0.3 * usual
    wanted = q + e
    J, J_d = (np.asarray(arm.jacobian(each), dtype=np.float64)[:3] for each in (q, wanted))
    rest = J_d @ rate - J @ rate
    right, printed = rest - GAIN * (J @ e), rest - J @ e
    point = np.asarray(arm.position(q), dtype=np.float64)
    return Drawn(
        f"Each joint is {OFF:g} rad (sliding ones {OFF * SLIDING:g} m) from where it is to be, and K = {GAIN:g} 1/s. "
        "The change of the tool's error is blue; without the gain it is red.",
        float(np.linalg.norm(printed - right)),
        "m/s",
        arrows(point, (printed, right), arm, ("printed", "ėₚ")),
        unseen="The errors of the joints do not move the tool here.",
    )


ON_ARM: dict[str, OnArm] = {"5.58": _last_column, "5.43": _angle_rates, "7.23": _error_rate}
"""Drawings, by the id of the erratum."""
