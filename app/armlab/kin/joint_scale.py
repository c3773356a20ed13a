"""A common measure of speed for revolute and prismatic joints, which have no common unit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm

DEFAULT_SPEED = 1.0
"""Speed, rad/s or m/s, that stands for the limit of a joint without one when joints are compared."""


def counted_speeds(arm: Arm) -> NDArray[np.float64] | None:
    """Return the speed of each joint that counts as 1, shape (n,), rad/s or m/s; None where all turn or all slide.

    It is the limit of the joint, `DEFAULT_SPEED` where none is known.
    """
    if arm.revolute.all() or not arm.revolute.any():
        return None
    return np.where(np.isfinite(arm.speed_limits), arm.speed_limits, DEFAULT_SPEED)


def joint_scale(arm: Arm) -> NDArray[np.float64]:
    """Return `counted_speeds` (n,), or ones when all joints are revolute or all prismatic."""
    speeds = counted_speeds(arm)
    return np.ones(arm.n) if speeds is None else speeds


def jacobian_size(arm: Arm, speeds: NDArray[np.float64], length: float = 1.0) -> float:
    """Return the size of the scaled task Jacobian of an arm: of what its fastest joint does to the tool.

    A joint that turns moves the tool by the length scale times its speed, one that slides by its speed.

    Parameters
    ----------
    arm : Arm
    speeds : ndarray, shape (n,)
        Speed of each joint, rad/s or m/s, that counts as 1.
    length : float
        Metres that count as 1 in a task without rotation; in others the length scale does.
    """
    return linear_size(arm, speeds) / (length if arm.task.rotation == "none" else arm.length_scale)


def linear_size(arm: Arm, speeds: NDArray[np.float64]) -> float:
    """Return the size of the linear rows of the scaled Jacobian of an arm, m/s, as in `jacobian_size`."""
    return float((speeds * np.where(arm.revolute, arm.length_scale, 1.0)).max())


def angular_size(arm: Arm, speeds: NDArray[np.float64]) -> float:
    """Return the size of the angular rows of the scaled Jacobian of an arm, rad/s; 0 where no joint turns."""
    return float(speeds[arm.revolute].max(initial=0.0))
