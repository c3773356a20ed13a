"""The tool point: a point fixed to the tool, and its place in the world."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Json, Part, PartType, State

FARTHEST = 100.0
"""Largest distance of a point from the tool's frame, metres."""

Xyz = tuple[float, float, float]


@dataclass(frozen=True)
class Point(Part):
    """A point of the tool.

    Attributes
    ----------
    xyz : tuple of float
        In the axes of the tool's frame {E}, metres; the origin of {E} unless it was moved.
    """

    key: ClassVar[str] = "point"

    xyz: Xyz = (0.0, 0.0, 0.0)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the origin of the tool's frame."""
        return cls()

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the point: it belongs to the tool."""
        return self

    def to_json(self) -> Json:
        """Write the coordinates."""
        return list(self.xyz)

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the coordinates."""
        x, y, z = data
        return cls(_checked((float(x), float(y), float(z))))


PART = PartType(Point, order=15)


def world_point(state: State) -> NDArray[np.float64]:
    """Return the tool point in the world in metres, shape (3,): ``p_w = T_wE p_E``.

    References
    ----------
    Notes, the text after 1.6.
    """
    T = state[Joints].tool_pose
    return np.array(T[:3, :3] @ state[Point].xyz + T[:3, 3], dtype=np.float64)


@dataclass(frozen=True)
class SetPoint(Command):
    """Place the tool point in the tool's frame {E}, metres."""

    xyz: Xyz
    label: ClassVar[str] = "tool point"

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        return state if self.xyz == state[Point].xyz else state.replace(Point(_checked(self.xyz)))


def _checked(xyz: Xyz) -> Xyz:
    for axis, value in zip("xyz", xyz, strict=True):
        if not (math.isfinite(value) and abs(value) <= FARTHEST):
            raise InputError(f"tool point, {axis}: expected at most {FARTHEST:g} m either way, got {value:.6g} m")
    return xyz
