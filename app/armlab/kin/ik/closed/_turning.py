"""The spherical wrist: a rotation as three rotations about axes through one point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from armlab.kin.ik.closed_form import FREE_ANGLES
from armlab.kin.ik.screws import Vector, across, angle_about, cross, rotation
from armlab.kin.ik.trig import sine_cosine

STRAIGHT = 1e-10
"""Sine of the angle of the first and last axis below which they are one line."""

RIGHT = 1e-9
"""Cosine of the angle of neighbouring axes below which it counts as a right angle."""


@dataclass(frozen=True)
class Turned:
    """Three angles; with ``free`` the first was chosen freely and the last adapted to it."""

    q: tuple[float, float, float]
    free: bool


def turn(z: Sequence[Vector], R: Vector) -> list[Turned]:
    """Return all angles with Rot(z0, q0) Rot(z1, q1) Rot(z2, q2) = R.

    R carries z2 to R z2, which joints 0 and 1 alone must do; z0 . Rot(z1, q1) z2 = z0 . R z2 is one equation
    a sin + b cos = c for q1. Then q0 follows about z0, and q2 from the rotation that is left.

    Parameters
    ----------
    z : three ndarrays, shape (3,)
        Unit directions at zero, neighbours not parallel.
    R : ndarray, shape (3, 3)

    References
    ----------
    Pieper 1968; Siciliano et al., *Robotics*, 2.12.5.
    """
    z0, z1, z2 = z
    goal = R @ z2
    a, b = float(z0 @ cross(z1, z2)), float(z0 @ z2 - (z0 @ z1) * (z1 @ z2))
    c = float(z0 @ goal - (z0 @ z1) * (z1 @ z2))
    right = abs(z0 @ z1) < RIGHT and abs(z1 @ z2) < RIGHT
    # The sine of the angle between first and last axis, known better than as sqrt(1 - cos²).
    sine = across(z0, goal)
    root = (sine if sine > STRAIGHT else 0.0) if right else None
    found: list[Turned] = []
    for q1 in sine_cosine(a, b, c, 1.0, root).values:
        moved = rotation(z1, q1) @ z2
        along = min(across(z0, moved), sine)
        free = along <= STRAIGHT
        for q0 in FREE_ANGLES if free else (angle_about(z0, moved, goal),):
            rest = (rotation(z0, q0) @ rotation(z1, q1)).T @ R
            side = cross(z2, z1)
            found.append(Turned((float(q0), q1, angle_about(z2, side, rest @ side)), free))
    return found
