"""A point on the circle of joint speeds of length 1, and its image under the Jacobian."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import Manipulability
from armlab.content.robots import Robot
from armlab.session.fields import FieldPart, Set, number
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Json, PartType, State

Array = NDArray[np.float64]

POINTS = 73
"""Number of points of a circle that is drawn."""


@dataclass(frozen=True)
class UnitCircle(FieldPart):
    """The marked joint speeds of length 1, which do not depend on the arm.

    Attributes
    ----------
    angle : float
        Radians, from the axis of the first joint's speed to that of the second's.
    """

    key: ClassVar[str] = "unit_circle"
    kept_by_undo: ClassVar[bool] = True

    angle: float = number("", "direction of the joint speeds", math.radians(30.0), unit="rad")

    def to_json(self) -> Json:
        """Write the angle."""
        return self.angle

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the angle; `InputError` if it is not finite."""
        return cls().with_values({"angle": data})


PART = PartType(UnitCircle, order=96)


class Mapped(NamedTuple):
    """The circle and its image.

    Attributes
    ----------
    ellipse : ndarray, shape (POINTS, 2)
        Image of the circle, in m/s along the two rows; it closes.
    speeds, velocity : ndarray, shape (2,)
        The marked point, in parts of the speeds that count as 1, and its image, m/s.
    axes : ndarray, shape (2, 2)
        Columns sigma_i u_i: the half axes of the ellipse.
    preimages : ndarray, shape (2, 2)
        Columns v_i: the joint speeds that give them.
    """

    ellipse: Array
    speeds: Array
    velocity: Array
    axes: Array
    preimages: Array


def mapped(state: State) -> Mapped | None:
    """Return the circle of joint speeds and its image, or None unless the arm has two joints and the block two rows."""
    block, joints = state[Manipulability].block, state[Joints]
    if joints.arm.n != 2 or block.m != 2:
        return None
    J = block.rows(joints.q) if block.speeds is None else block.rows(joints.q) * block.speeds
    angle = state[UnitCircle].angle
    speeds = np.array([math.cos(angle), math.sin(angle)])
    found = block.ellipsoid(joints.q)
    return Mapped(_circle() @ J.T, speeds, J @ speeds, found.axes * found.sigma, np.array(found.joint_directions))


def _circle() -> Array:
    angle = np.linspace(0.0, 2.0 * math.pi, POINTS)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@dataclass(frozen=True)
class MarkSpeeds(Command):
    """Mark the joint speeds of length 1 at an angle, radians; sent by a slider in motion."""

    angle: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the point at the angle."""
        return Set(UnitCircle, "angle", self.angle).apply(state)
