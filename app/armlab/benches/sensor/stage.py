"""Place and size of the encoder: above the base of the arm, which is hidden, and turned towards the home view."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

HEIGHT, RADIUS = 0.37, 0.33
"""Height of its middle above the base, and radius of the disk, in reaches of the arm."""

ASIDE = math.radians(32.0)
"""Angle by which its axis is turned sideways from the home view, so that lamps and sensors are seen apart."""


def stage_of(state: State) -> tuple[Floats, float]:
    """Return the pose of the encoder, (4, 4), and the radius of its disk, metres.

    The z axis is that of the shaft, towards the home view; y goes up to the sensors, as seen from there.
    """
    robot = state[RobotPart].robot
    reach = 2.0 * robot.arm.length_scale
    azimuth, elevation = math.radians(robot.camera.azimuth_deg), math.radians(robot.camera.elevation_deg)
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    level = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    towards = math.cos(elevation) * level + math.sin(elevation) * np.array([0.0, 0.0, 1.0])
    z, y = math.cos(ASIDE) * towards + math.sin(ASIDE) * right, np.cross(towards, right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([np.cross(y, z), y, z], axis=1)
    pose[:3, 3] = robot.arm.base[:3, 3] + np.array([0.0, 0.0, HEIGHT * reach])
    return pose, RADIUS * reach


def around(state: State) -> Floats:
    """Return the corners (8, 3) of what belongs in the picture."""
    pose, radius = stage_of(state)
    corners = np.array([[x, y, z] for x in (-1.1, 1.1) for y in (-1.15, 1.5) for z in (-0.5, 0.3)])
    return np.asarray(pose[:3, 3] + radius * corners @ pose[:3, :3].T)


def turned(pose: Floats, angle: float) -> Floats:
    """Return a pose (4, 4) turned about its own z axis by an angle in radians."""
    cosine, sine = math.cos(angle), math.sin(angle)
    turn = np.eye(4)
    turn[:2, :2] = [[cosine, -sine], [sine, cosine]]
    return np.asarray(pose @ turn)
