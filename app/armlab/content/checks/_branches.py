"""The branch in which an arm stands: the sides on which its elbow, its shoulder and its wrist are.

Everything is told from points and lines in space, so it holds for both conventions, for any offsets of the joint
values and wherever the base stands. Words as in Siciliano et al., *Robotics*, 2.12: the elbow of a planar arm is up
where q2 is negative, that is, to the left of the way from shoulder to hand, seen against the axes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.relations import Axes

Vector = NDArray[np.float64]
Side = Literal["first", "second", "neither"]

STRAIGHT = 1e-3
"""Distance from the line through shoulder and hand, relative to the reach, below which the elbow is on neither side;
also for the shoulder."""

FLAT_WRIST = 1e-3
"""Angle of joint 5 from straight, in radians, below which a wrist is in neither branch."""


@dataclass(frozen=True, eq=False)
class Branches:
    """The branches that an arm with this table has, and the one in which it stands."""

    arm: Arm

    @cached_property
    def axes(self) -> Axes:
        return Axes(self.arm)

    @cached_property
    def planar(self) -> bool:
        """Whether the arm is planar with two or three revolute joints."""
        n = self.arm.n
        return n in (2, 3) and self.axes.turns(1, n) and all(self._parallel_apart(i) for i in range(1, n))

    @cached_property
    def turning(self) -> bool:
        """Whether joint 1 turns the plane of a shoulder and an elbow, as in most arms with six joints."""
        axes = self.axes
        if self.arm.n < 3 or not axes.turns(1, 3):
            return False
        return axes.perpendicular(1) and self._parallel_apart(2) and (self.arm.n == 3 or self.wrist or self._runs_on)

    @cached_property
    def wrist(self) -> bool:
        """Whether the last three of six axes meet, with axes 4, 5 and 6 at right angles."""
        axes = self.axes
        return self.arm.n == 6 and axes.meet(4) and axes.perpendicular(4) and axes.perpendicular(5)

    @cached_property
    def sided(self) -> bool:
        """Whether an arm with a spherical wrist is offset from axis 1, so that its shoulder has two sides."""
        return self.turning and self.wrist and abs(self._beside(np.zeros(self.arm.n))) > STRAIGHT * self.arm.reach

    def elbow(self, q: ArrayLike) -> Side:
        """Return "first" where the elbow is up, "second" where it is down.

        For a planar arm, up is to the left of the way from shoulder to hand, seen against the axes; of a turning one it
        is towards the end of axis 1, above the line from shoulder to wrist.
        """
        shoulder, elbow, hand = self._plane_points(q)
        way = hand - shoulder
        length = float(np.linalg.norm(way))
        if length <= STRAIGHT * self.arm.reach:
            return "neither"
        way = way / length
        aside = (elbow - shoulder) - ((elbow - shoulder) @ way) * way
        first_axis = self._axis(q, 1)[1]
        up = np.cross(first_axis, way) if self.planar else first_axis
        return _side(float(aside @ up), STRAIGHT * self.arm.reach)

    def front(self, q: ArrayLike) -> Side:
        """Return "first" when the wrist is in front of axis 1, on the side of x1, and "second" when it is behind."""
        point = self._plane_points(q)[2] - self._axis(q, 1)[0]
        return _side(float(point @ self._frames(q)[1, :3, 0]), STRAIGHT * self.arm.reach)

    def side(self, q: ArrayLike) -> Side:
        """Return "first" when the arm is left of the line from axis 1 to the wrist, "second" when it is right of it."""
        beside = self._beside(q)
        axis_point, up = self._axis(q, 1)
        across = self._axis(q, 2)[1]
        point = self._plane_points(q)[2] - axis_point
        ahead = point - (point @ across) * across - (point @ up) * up
        left = np.cross(up, ahead)
        return _side(float(left @ across) * math.copysign(1.0, beside), STRAIGHT * self.arm.reach)

    def hand(self, q: ArrayLike) -> Side:
        """Return "first" when joint 5 of a spherical wrist is at a positive angle from straight, else "second"."""
        angle = math.remainder(float(np.asarray(q)[4]) + self.arm.rows[4].theta, math.tau)
        return _side(math.sin(angle), FLAT_WRIST)

    @cached_property
    def _runs_on(self) -> bool:
        """Whether axis 4 is parallel to axes 2 and 3, so that the forearm ends there."""
        return self._parallel_apart(3) and self.axes.turns(1, 4)

    def _parallel_apart(self, link: int) -> bool:
        return self.axes.parallel(link) and not self.axes.touching(link)

    def _frames(self, q: ArrayLike) -> Vector:
        return np.asarray(self.arm.frames(np.asarray(q, dtype=np.float64)), dtype=np.float64)

    def _axis(self, q: ArrayLike, joint: int) -> tuple[Vector, Vector]:
        """Return a point and the direction of a joint axis (1-based) in the world."""
        T = self._frames(q)[joint - 1 if self.arm.convention == "standard" else joint]
        return T[:3, 3], T[:3, 2]

    def _hand(self, q: ArrayLike) -> Vector:
        """Return the end of the forearm."""
        if self.arm.n > 3:
            # Axes 4, 5 and 6 of a spherical wrist meet in the origin of frame 4 in either convention.
            return self._frames(q)[4, :3, 3] if self.wrist else self._axis(q, 4)[0]
        if self.planar and self.arm.n == 3:
            return self._axis(q, 3)[0]
        return np.asarray(self.arm.position(np.asarray(q, dtype=np.float64)), dtype=np.float64)

    def _plane_points(self, q: ArrayLike) -> tuple[Vector, Vector, Vector]:
        """Return shoulder, elbow and end of the forearm, moved along their parallel axes into one plane."""
        first = 1 if self.planar else 2
        shoulder, direction = self._axis(q, first)
        found = [shoulder, self._axis(q, first + 1)[0], self._hand(q)]
        # Into the plane that contains axis 1, where it is perpendicular to them.
        origin = self._axis(q, 1)[0]
        moved = [p - ((p - origin) @ direction) * direction for p in found]
        return moved[0], moved[1], moved[2]

    def _beside(self, q: ArrayLike) -> float:
        """Return the distance of the end of the forearm from the plane of axis 1, along axis 2, in metres."""
        origin, across = self._axis(q, 1)[0], self._axis(q, 2)[1]
        return float((self._hand(q) - origin) @ across)


def other_elbow(arm: Arm, q: ArrayLike) -> Vector | None:
    """Return the configuration of a planar 2R that is mirrored at the line from shoulder to tool; None for others.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> np.degrees(other_elbow(arm, np.radians([0.0, 90.0]))).round(6).tolist()
    [90.0, -90.0]
    """
    branches = Branches(arm)
    if arm.n != 2 or not branches.planar:
        return None
    values = np.array(q, dtype=np.float64)
    shoulder, elbow, hand = branches._plane_points(values)
    axis, second = branches._axis(values, 1)[1], branches._axis(values, 2)[1]

    def turn(u: Vector, v: Vector) -> float:
        return float(math.atan2(np.cross(u, v) @ axis, u @ v))

    upper, fore, way = elbow - shoulder, hand - elbow, hand - shoulder
    # Mirrored, each link makes the same angle with the line on its other side.
    first, bend = 2.0 * turn(upper, way), -2.0 * turn(upper, fore)
    sense = 1.0 if axis @ second > 0.0 else -1.0
    return np.array([math.remainder(values[0] + first, math.tau), math.remainder(values[1] + sense * bend, math.tau)])


def _side(value: float, least: float) -> Side:
    return "first" if value > least else "second" if value < -least else "neither"
