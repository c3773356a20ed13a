"""Errata on orientations, drawn on an arm: the tool's axes as the printed formula would have them, and as they are."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from armlab.benches.lessons.errata.on_arm.drawn import LONG, SEEN, Drawn, Floats, OnArm, Segment, Unfit
from armlab.kin.arm import Arm
from armlab.kin.axis_angle import angle_by_atan2
from armlab.kin.errata.quaternion_signs import by_signs, matrix_of
from armlab.kin.euler import euler_angles
from armlab.kin.rotations import axis_angle, euler_zyx, rotation_about, rotation_from_axis_angle

SINGULAR = 1e-6
"""Sine of an angle, below which it counts as 0 or a half turn."""

Written = Callable[[Floats], tuple[Floats, str] | str]
"""Function from R to the printed matrix and the words on it, or why there is none."""


def _of_tool(written: Written) -> OnArm:
    """Return what draws the axes of the tool that a printed formula moves."""

    def on_arm(arm: Arm, q: Floats) -> Drawn | Unfit:
        T = np.asarray(arm.fk(q), dtype=np.float64)
        R, point = T[:3, :3], T[:3, 3]
        found = written(R)
        if isinstance(found, str):
            return Unfit(found)
        printed, says = found
        apart = [_angle(printed[:, k], R[:, k]) for k in range(3)]
        moved = [k for k in range(3) if apart[k] > SEEN]
        reached = LONG * arm.reach
        wrong = [Segment(point, point + reached * printed[:, k], True, label=f"printed: {'xyz'[k]}") for k in moved]
        right = [Segment(point, point + reached * R[:, k], False, label="xyz"[k]) for k in moved]
        return Drawn(says, max(apart), "rad", (*wrong, *right), unseen="In this orientation both are the same.")

    return on_arm


def _angle(a: Floats, b: Floats) -> float:
    """Return the angle between two vectors, or their distance if the first one is no unit vector and points alike."""
    between = math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))
    return max(between, abs(float(np.linalg.norm(a)) - 1.0))


def _by_angle(R: Floats) -> tuple[Floats, str] | str:
    axis, angle = axis_angle(R)
    if float(angle) < SINGULAR:
        return "The tool is not turned: there is no axis. Turn a joint."
    found = float(angle_by_atan2(R, 0.5))
    return (
        np.asarray(rotation_from_axis_angle(axis, found)),
        "The tool's axes are blue; those of a turn about the same axis by the printed angle are red.",
    )


def _by_quaternion(R: Floats) -> tuple[Floats, str] | str:
    return (
        matrix_of(by_signs(R, (2, 1))),
        "The tool's axes are blue; those of the quaternion with the printed sign are red.",
    )


def _by_rpy(row: int, column: int) -> Written:
    def written(R: Floats) -> tuple[Floats, str] | str:
        (yaw, pitch, roll), _ = euler_zyx(R)
        printed = R.copy()
        if (row, column) == (0, 1):
            printed[0, 1] = math.cos(yaw) * math.sin(roll) - math.sin(yaw) * math.cos(roll)
        else:
            printed[1, 2] = math.sin(yaw) * math.sin(pitch) * math.cos(yaw) - math.cos(yaw) * math.sin(roll)
        axis = "xyz"[column]
        return printed, f"The {axis} axis of the tool is blue; as its roll, pitch and yaw would give it, it is red."

    return written


def _by_zxz(R: Floats) -> tuple[Floats, str] | str:
    phi, theta, psi = euler_angles(R, "zxz").solutions[0]
    printed = R.copy()
    printed[1, 0] = math.sin(phi) * math.sin(psi) + math.cos(phi) * math.cos(theta) * math.sin(psi)
    return printed, "The x axis of the tool is blue; as its ZX′Z″ angles would give it, it is red."


def _singular_zxz(R: Floats) -> tuple[Floats, str] | str:
    if math.hypot(R[0, 2], R[1, 2]) > SINGULAR:
        return "The z axis of the tool points neither straight up nor straight down: the angles are not singular here."
    if R[2, 2] > 0.0:
        return R, "The tool points straight up: θ = 0, where the printed formula holds."
    phi = math.atan2(R[1, 0], R[0, 0])  # with psi = 0
    return (
        np.asarray(rotation_about("z", phi)),
        "The tool points straight down: θ = π. The axes of R_z(φ + ψ), which is a turn about z only, are red.",
    )


ON_ARM: dict[str, OnArm] = {
    "3.66": _of_tool(_by_angle),
    "3.78": _of_tool(_by_quaternion),
    "3.82": _of_tool(_by_zxz),
    "3.94": _of_tool(_singular_zxz),
    "3.103a": _of_tool(_by_rpy(0, 1)),
    "3.103b": _of_tool(_by_rpy(1, 2)),
}
"""Drawings, by the id of the erratum."""
