"""The moving bodies of an arm: how each hangs on the one before, and how thick everything is.

Body 0 is the base, body i (1 to n) moves with joint i. The node of a body stands on the joint's axis and moves by the
joint variable alone: about its z axis for a revolute joint, along it for a prismatic one. So a moving arm is one
quaternion or one position for each joint, and everything drawn hangs on these nodes. Standard and modified tables give
the same bodies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import common_normals, link_transform
from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.transforms import inverse

Pose = NDArray[np.float64]

SMALLEST = 1e-6
"""Least sum of lengths, metres, with which an arm can be drawn to scale."""


@dataclass(frozen=True, eq=False)
class Body:
    """One moving body.

    Attributes
    ----------
    revolute : bool
    mount : ndarray, shape (4, 4)
        Pose of the joint axis in the node of the body before, theta offset included.
    d, a, alpha : float
        What follows on the body: d along z (0 for a prismatic joint, whose node moves), then the common normal.
    offset : float
        Distance from the mount to the node of a prismatic joint at q = 0.
    low, high : float
        Joint limits.
    """

    revolute: bool
    mount: Pose
    d: float
    a: float
    alpha: float
    offset: float
    low: float
    high: float

    @property
    def end(self) -> Pose:
        """The pose of the next body in the node of this one."""
        return np.array(link_transform(self.a, self.alpha, self.d, 0.0))

    @property
    def length(self) -> float:
        """Length of the body, |d| + |a|, with the stroke of a prismatic joint, metres."""
        return abs(self.d) + abs(self.a) + (0.0 if self.revolute else self.high + self.offset)

    def node_wxyz(self, q: float) -> tuple[float, float, float, float]:
        """Return the orientation of the node in the node before, as wxyz."""
        w, x, y, z = self._mount_wxyz
        if not self.revolute:
            return w, x, y, z
        c, s = math.cos(q / 2.0), math.sin(q / 2.0)
        return w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s

    def node_position(self, q: float) -> tuple[float, float, float]:
        """Return the position of the node in the node before."""
        along = 0.0 if self.revolute else self.offset + q
        (px, py, pz), (zx, zy, zz) = self._mount_axis
        return px + along * zx, py + along * zy, pz + along * zz

    @cached_property
    def _mount_axis(self) -> tuple[list[float], list[float]]:
        return self.mount[:3, 3].tolist(), self.mount[:3, 2].tolist()

    @cached_property
    def _mount_wxyz(self) -> tuple[float, float, float, float]:
        w, x, y, z = quaternion_from_rotation(self.mount[:3, :3]).tolist()
        return w, x, y, z


@dataclass(frozen=True, eq=False)
class Anatomy:
    """All bodies of an arm and the proportions they share.

    Attributes
    ----------
    arm : Arm
    root : ndarray, shape (4, 4)
        Pose of the node of the base in the world; z is the axis of joint 1.
    bodies : tuple of Body
    size : float
        All lengths of the table in a line, without the tool, in metres; every thickness is a part of it.
    radius : ndarray, shape (n+1,)
        Radius of the tube at each joint and at the end.
    """

    arm: Arm
    root: Pose
    bodies: tuple[Body, ...]
    size: float
    radius: NDArray[np.float64]

    def tool_on_last(self) -> Pose:
        """Return the tool in the node of the last body."""
        return np.array(self.bodies[-1].end @ self.arm.tool)

    def frame_on_body(self, i: int) -> tuple[int, Pose]:
        """Return the body to which frame i (0 to n) is fixed, and its pose in the node of that body."""
        if i == 0:
            return 0, np.array(inverse(self.root) @ self.arm.base)
        body = self.bodies[i - 1]
        if self.arm.convention == "standard":
            return i, body.end
        return i, np.array(link_transform(0.0, 0.0, body.d, 0.0))


def anatomy_of(arm: Arm) -> Anatomy:
    """Return the bodies of an arm."""
    links = common_normals(arm.rows, arm.convention)
    root = arm.base @ link_transform(*links[0], 0.0, 0.0)
    bodies: list[Body] = []
    hang = np.eye(4)
    for i, row in enumerate(arm.rows):
        a, alpha = links[i + 1]
        body = Body(
            revolute=row.revolute,
            mount=np.array(hang @ link_transform(0.0, 0.0, 0.0, row.theta)),
            d=row.d if row.revolute else 0.0,
            a=a,
            alpha=alpha,
            offset=0.0 if row.revolute else row.d,
            low=float(arm.limits[i, 0]),
            high=float(arm.limits[i, 1]),
        )
        bodies.append(body)
        hang = body.end
    size = arm.reach - float(np.linalg.norm(arm.tool[:3, 3]))
    if size < SMALLEST:
        size = 1.0
    thinning = 0.45 / max(arm.n, 3)
    radius = 0.034 * size * (1.0 - thinning * np.arange(arm.n + 1, dtype=np.float64))
    return Anatomy(arm, np.array(root), tuple(bodies), size, radius)
