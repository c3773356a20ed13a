"""Place and size of the body: above the base of the arm, which is hidden, so that the home view of the arm shows it."""

from __future__ import annotations

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


def around(state: State, wide: float = 1.0) -> Floats:
    """Return the corners (2, 3) of what belongs in the picture, ``wide`` times as far sideways as up."""
    centre, radius = stage_of(state)
    corner = radius * np.array([1.2 * wide, 1.2 * wide, 1.5])
    return np.array([centre - corner, centre + corner])


def pose_at(R: Floats, centre: Floats) -> Floats:
    """Return the pose (4, 4) of something turned by R with its middle at a point (3,)."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R, centre
    return pose
