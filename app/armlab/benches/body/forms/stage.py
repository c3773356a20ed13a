"""Place and size of the body: above the base of the arm, which is hidden, so that the home view of the arm shows it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

HEIGHT, RADIUS = 0.38, 0.3
"""Height of its middle above the base, and radius of the outermost ring, in reaches of the arm."""


def stage_of(state: State) -> tuple[Floats, float]:
    """Return the middle of the body, shape (3,), and the radius of the outermost ring, metres."""
    arm = state[RobotPart].robot.arm
    reach = 2.0 * arm.length_scale
    return arm.base[:3, 3] + np.array([0.0, 0.0, HEIGHT * reach]), RADIUS * reach


def around(state: State) -> Floats:
    """Return the corners (2, 3) of what belongs in the picture."""
    centre, radius = stage_of(state)
    corner = radius * np.array([1.2, 1.2, 1.5])
    return np.array([centre - corner, centre + corner])


def pose_at(R: Floats, centre: Floats) -> Floats:
    """Return the pose (4, 4) of something turned by R with its middle at a point (3,)."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R, centre
    return pose


def towards_eye(state: State) -> Floats:
    """Return the unit vector (3,) towards the eye in the home view of the arm."""
    camera = state[RobotPart].robot.camera
    azimuth, elevation = math.radians(camera.azimuth_deg), math.radians(camera.elevation_deg)
    c = math.cos(elevation)
    return np.array([c * math.cos(azimuth), c * math.sin(azimuth), math.sin(elevation)])


def sides_of(state: State) -> tuple[tuple[Floats, Floats], float]:
    """Return the middles of two bodies side by side in the home view of the arm, (3,) each, and their radius."""
    centre, radius = stage_of(state)
    right = _right(state)
    return (centre - 0.95 * radius * right, centre + 0.95 * radius * right), 0.75 * radius


def _right(state: State) -> Floats:
    azimuth = math.radians(state[RobotPart].robot.camera.azimuth_deg)
    return np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])


def around_both(state: State) -> Floats:
    """Return the ends of what belongs in the picture of two bodies, (4, 3)."""
    (one, other), radius = sides_of(state)
    aside, up = 1.42 * radius * _right(state), np.array([0.0, 0.0, 1.45 * radius])
    return np.array([one - aside, one - up, other + aside, other + up])
