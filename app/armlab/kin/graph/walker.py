"""Walk along a chain of elementary moves and keep the pose of the moving frame as expressions.

The turn about the current z axis is kept pending as an angle, so turns about parallel axes add up before any sine is
taken: a planar 3R needs the sines of q1, q1+q2 and q1+q2+q3, as in the textbook, and nothing else.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Number, cos, sin
from armlab.kin.graph.vector import Vector

SNAP = 1e-12
"""Distance of a constant cosine or sine from 0, 1 or -1 below which it is taken as exact: tables say 90 degrees."""


class Frame(NamedTuple):
    """Axes and origin of a frame, in the frame in which the walk began."""

    x: Vector
    y: Vector
    z: Vector
    p: Vector


ORIGIN = Frame((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


def exact(value: float) -> float:
    """Return the value, or 0, 1 or -1 when it is within `SNAP` of them."""
    nearest = float(round(value))
    return nearest if abs(nearest) <= 1 and abs(value - nearest) < SNAP else float(value)


@dataclass
class Walker:
    """A moving frame: axes ``u, v, w`` before the pending turn ``angle`` about ``w``, and the origin ``p``."""

    u: Vector = ORIGIN.x
    v: Vector = ORIGIN.y
    w: Vector = ORIGIN.z
    p: Vector = ORIGIN.p
    angle: Number = 0.0

    @classmethod
    def at(cls, frame: Frame) -> Walker:
        """Return a walker that stands in this frame."""
        return cls(*frame)

    def frame(self) -> Frame:
        """Return the present frame."""
        c, s = cos(self.angle), sin(self.angle)
        x = vec.combine(c, self.u, s, self.v)
        y = vec.combine(c, self.v, -s, self.u)
        return Frame(x, y, self.w, self.p)

    def turn_z(self, angle: Number) -> None:
        """Turn about z. Constant angles turn the axes at once, so that offsets of 90 degrees stay exact."""
        if isinstance(angle, float):
            c, s = exact(math.cos(angle)), exact(math.sin(angle))
            self.u, self.v = vec.combine(c, self.u, s, self.v), vec.combine(c, self.v, -s, self.u)
        else:
            self.angle = self.angle + angle

    def move_z(self, distance: Number) -> None:
        """Move along z."""
        self.p = vec.along(self.p, distance, self.w)

    def move_x(self, distance: Number) -> None:
        """Move along x."""
        if isinstance(distance, float) and distance == 0.0:
            return
        c, s = cos(self.angle), sin(self.angle)
        self.p = vec.add(self.p, vec.combine(distance * c, self.u, distance * s, self.v))

    def turn_x(self, c: Number, s: Number) -> None:
        """Turn about x by the angle with cosine ``c`` and sine ``s``."""
        if isinstance(s, float) and s == 0.0:
            if c == -1.0:
                self.v, self.w, self.angle = _opposite(self.v), _opposite(self.w), -self.angle
            return
        x, y, z, _ = self.frame()
        self.u, self.angle = x, 0.0
        self.v, self.w = vec.combine(c, y, s, z), vec.combine(c, z, -s, y)

    def place(self, matrix: list[list[float]]) -> None:
        """Multiply by a constant 4 x 4 pose on the right."""
        x, y, z, p = self.frame()
        rotation = [[exact(value) for value in row[:3]] for row in matrix[:3]]
        columns = [_in_axes((x, y, z), [row[j] for row in rotation]) for j in range(3)]
        shift = _in_axes((x, y, z), [float(row[3]) for row in matrix[:3]])
        self.u, self.v, self.w = columns
        self.p, self.angle = vec.add(p, shift), 0.0


def _opposite(a: Vector) -> Vector:
    return (-a[0], -a[1], -a[2])


def _in_axes(axes: tuple[Vector, Vector, Vector], components: list[float]) -> Vector:
    first = vec.combine(components[0], axes[0], components[1], axes[1])
    return vec.along(first, components[2], axes[2])
