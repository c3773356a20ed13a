"""Place of a model in the scene: above the base of the arm, which is hidden, and turned towards the home view."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

HEIGHT, SIZE = 0.4, 0.17
"""Height of the middle of a model above the base, and the length of its unit, in reaches of the arm."""

ASIDE = math.radians(27.0)
"""Angle by which a model is turned away from the line of sight, so that its depth is seen, radians."""


def stage_of(state: State) -> tuple[Floats, float]:
    """Return where the model is, as a pose (4, 4), and the length of its unit in metres.

    In the picture of the home view x of the pose points to the right, y away from the eye and z up, all turned by
    `ASIDE` about z.
    """
    robot = state[RobotPart].robot
    reach = 2.0 * robot.arm.length_scale
    angle = math.radians(robot.camera.azimuth_deg) + 0.5 * math.pi - ASIDE
    pose = np.eye(4)
    pose[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    pose[:3, 3] = robot.arm.base[:3, 3] + np.array([0.0, 0.0, HEIGHT * reach])
    return pose, SIZE * reach


def placed_at(pose: Floats, unit: float, points: NDArray[np.floating]) -> Floats:
    """Return points or vectors (..., 3) of a model in the world: in its units, on its pose."""
    return np.asarray(unit * points @ pose[:3, :3].T + pose[:3, 3])


def turned(angle: float) -> Floats:
    """Return the turn of a rotor about y of the model, (3, 3); for the eye a positive angle is clockwise."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def around(state: State, half: tuple[float, float, float]) -> Floats:
    """Return the corners (8, 3) of a box around the model that belongs in the picture, with its half edges in units."""
    pose, unit = stage_of(state)
    signs = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    return placed_at(pose, unit, signs * np.array(half))
