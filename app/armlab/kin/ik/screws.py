"""The joint axes of an arm as lines in space: a description that does not depend on the table.

    T_0e(q) = E_1(q_1) E_2(q_2) ... E_n(q_n) home

with E_i the turn about, or the slide along, the place joint axis i has where all joint values are zero, and home the
pose of the tool there (product of exponentials). Offsets, base, tool and the convention of the table are all inside;
closed forms written on it hold for any of them.

References
----------
Brockett 1984; Murray, Li and Sastry, *A Mathematical Introduction to Robotic Manipulation*, 3.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.transforms import inverse, transform

Vector = NDArray[np.float64]

CLEAN = 1e-15
"""Rounding of quarter turns: smaller components of directions and rotations are set to zero."""


@dataclass(frozen=True, eq=False)
class Screws:
    """Joint axes at q = 0, in the axes of frame 0.

    Attributes
    ----------
    kinds : str
        Joint types, such as ``"RRP"``.
    z, o : ndarray, shape (n, 3)
        Directions, and points in metres; the point of a slide means nothing.
    home : ndarray, shape (4, 4)
        The tool at q = 0.
    scale : float
        The arm's length scale in metres.
    """

    kinds: str
    z: Vector
    o: Vector
    home: Vector
    scale: float

    def turn(self, i: int, q: float) -> Vector:
        """Return the rotation of joint i (0-based), the identity for a slide; shape (3, 3)."""
        if self.kinds[i] == "P":
            return np.eye(3)
        return rotation(self.z[i], q)

    def move(self, i: int, q: float) -> Vector:
        """Return E_i, shape (4, 4)."""
        if self.kinds[i] == "P":
            return np.asarray(transform(position=q * self.z[i]), dtype=np.float64)
        R = self.turn(i, q)
        return np.asarray(transform(R, self.o[i] - R @ self.o[i]), dtype=np.float64)

    def moved(self, i: int, q: float, point: Vector) -> Vector:
        """Return where E_i carries a point, shape (3,)."""
        if self.kinds[i] == "P":
            return np.asarray(point + q * self.z[i])
        return np.asarray(self.o[i] + self.turn(i, q) @ (point - self.o[i]))

    def reversed(self) -> Screws:
        """Return the arm seen from its tool: the same joints in the reverse order, and the same joint values.

        The inverse of the pose, home⁻¹ E_n⁻¹ ... E_1⁻¹, is a product of exponentials again.
        """
        back = inverse(self.home)
        z = -(self.z @ back[:3, :3].T)[::-1]
        o = (self.o @ back[:3, :3].T + back[:3, 3])[::-1]
        return Screws(self.kinds[::-1], z, o, np.asarray(back, dtype=np.float64), self.scale)


@lru_cache(maxsize=64)
def screws_of(arm: Arm) -> Screws:
    """Return the joint axes of an arm (arms are compared by identity)."""
    whole = np.asarray(inverse(arm.base) @ arm.frames(np.zeros(arm.n)), dtype=np.float64)
    axes = whole[:-1] if arm.convention == "standard" else whole[1:]
    home = np.asarray(whole[-1] @ arm.tool, dtype=np.float64)
    z = _clean(axes[:, :3, 2])
    z = z / np.linalg.norm(z, axis=1, keepdims=True)
    o = _clean(axes[:, :3, 3], CLEAN * arm.length_scale)
    kinds = "".join(row.kind for row in arm.rows)
    return Screws(kinds, z, o, _clean(home, CLEAN * min(1.0, arm.length_scale)), arm.length_scale)


def cross(u: Vector, v: Vector) -> Vector:
    """Return the vector product (3,) of two vectors; NumPy's, made for batches, takes ten times as long."""
    (a, b, c), (x, y, z) = u.tolist(), v.tolist()
    return np.array((b * z - c * y, c * x - a * z, a * y - b * x))


def rotation(axis: Vector, angle: float) -> Vector:
    """Return the rotation about a unit vector, shape (3, 3), as `rotation_from_axis_angle` does, for one vector."""
    x, y, z = axis.tolist()
    c, s = math.cos(angle), math.sin(angle)
    v = 1.0 - c
    return np.array(
        (
            (c + v * x * x, v * x * y - s * z, v * x * z + s * y),
            (v * x * y + s * z, c + v * y * y, v * y * z - s * x),
            (v * x * z - s * y, v * y * z + s * x, c + v * z * z),
        )
    )


def angle_about(z: Vector, start: Vector, end: Vector) -> float:
    """Return the right-handed angle about z from one direction to another, rad; 0 when one is along z."""
    # By their parts across z, each turned by a quarter: products of the whole would cancel where these are small.
    one, other = cross(z, start), cross(z, end)
    return math.atan2(float(z @ cross(one, other)), float(one @ other))


def across(z: Vector, v: Vector) -> float:
    """Return the length of the part of v perpendicular to the unit vector z, accurate also when it is small."""
    return float(np.linalg.norm(cross(z, v)))


def _clean(values: Vector, least: float = CLEAN) -> Vector:
    return np.where(np.abs(values) < least, 0.0, values)
