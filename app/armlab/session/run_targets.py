"""Targets of runs: the initial one, and those that are accepted."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.transforms import as_pose
from armlab.session.parts.target import FARTHEST

ASIDE = 0.4
"""Distance of each joint of the first target from the home pose, radians or fractions of half a stroke."""


def first_target(robot: Robot) -> NDArray[np.float64]:
    """Return the pose of the tool not far from home.

    The first joint a little towards the middle of its range, the others away from it, where there is room: in the
    middle arms are stretched, a singular configuration to begin with.
    """
    arm, home = robot.arm, np.asarray(robot.home, dtype=float)
    low, high = arm.limits.T
    inward = np.where(home <= 0.5 * (low + high), 1.0, -1.0)
    way = inward * np.where(arm.revolute, ASIDE, 0.5 * ASIDE * (high - low))
    aside = home - way
    inside = (aside >= low) & (aside <= high) & (np.arange(arm.n) > 0)
    pose = np.array(arm.fk(arm.clip(np.where(inside, aside, home + way))), dtype=np.float64)
    pose.setflags(write=False)
    return pose


def checked_target(robot: Robot, pose: ArrayLike) -> NDArray[np.float64]:
    """Return a target (4, 4), read-only; `InputError` when it is no pose or much too far away."""
    arm, checked = robot.arm, np.array(as_pose(pose, "target"), dtype=np.float64)
    if np.linalg.norm(checked[:3, 3] - arm.base[:3, 3]) > FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"target: farther than {FARTHEST:g} times the reach of the arm")
    checked.setflags(write=False)
    return checked


def target_after(robot: Robot, pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a target after an edit of the table: the same, or the first one where it is now much too far away."""
    try:
        return checked_target(robot, pose)
    except InputError:
        return first_target(robot)
