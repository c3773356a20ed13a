"""Place of what the pages of gears draw: a plane above the base of the arm, turned a little from the home view."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

HEIGHT, RADIUS = 0.38, 0.32
"""Height of its middle above the base, and half its height, in reaches of the arm."""

ASIDE, LOWER = math.radians(22.0), math.radians(14.0)
"""Angles by which its normal is turned from the line of sight of the home view, so that depth is seen, radians."""


class Stage(NamedTuple):
    """A plane for a drawing.

    Attributes
    ----------
    centre : ndarray, shape (3,)
    axes : ndarray, shape (3, 3)
        A rotation, whose columns point to the right, upwards in the plane, and towards the eye.
    radius : float
        Half the height of what is drawn, metres; it may be twice as wide.
    """

    centre: Floats
    axes: Floats
    radius: float

    def at(self, right: float, up: float = 0.0, near: float = 0.0) -> Floats:
        """Return a point by its coordinates in the plane and before it, metres, shape (3,)."""
        return np.asarray(self.centre + self.axes @ np.array([right, up, near]))

    def pose(self, right: float, up: float = 0.0, near: float = 0.0, angle: float = 0.0) -> Floats:
        """Return the pose (4, 4) of something at a point of the plane, turned in it by an angle in radians."""
        c, s = math.cos(angle), math.sin(angle)
        pose = np.eye(4)
        pose[:3, :3] = self.axes @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        pose[:3, 3] = self.at(right, up, near)
        return pose


def stage_of(state: State) -> Stage:
    """Return the plane for the arm of a state."""
    robot = state[RobotPart].robot
    reach, view = 2.0 * robot.arm.length_scale, robot.camera
    azimuth = math.radians(view.azimuth_deg) - ASIDE
    elevation = max(math.radians(view.elevation_deg) - LOWER, 0.0)
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    level = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    near = math.cos(elevation) * level + np.array([0.0, 0.0, math.sin(elevation)])
    axes = np.column_stack([right, np.cross(near, right), near])
    return Stage(robot.arm.base[:3, 3] + np.array([0.0, 0.0, HEIGHT * reach]), axes, RADIUS * reach)


def around(state: State, wide: float = 2.0) -> Floats:
    """Return corners (4, 3) of what belongs in the picture, ``wide`` times as wide as it is high."""
    stage = stage_of(state)
    across, up = 1.05 * wide * stage.radius, 1.25 * stage.radius
    return np.array([stage.at(x, y) for x in (-across, across) for y in (-up, up)])
