"""Projection of a target onto what the task of an arm controls."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import inverse, transform


def feasible(arm: Arm, T: NDArray[np.floating], tool: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the part of a wanted pose that an arm's task can ask for, completed to a pose.

    Coordinates outside the task are the tool's. So is the orientation of a task without rotation; with ``"phi"`` the
    tool's is turned about z of frame 0, as far as the wanted one asks. With ``"approach"`` and ``"full"`` the whole
    orientation is the wanted one: of an approach direction the turn about it is kept though it is not controlled,
    which costs nothing and lets a hand turn its handle freely.

    Parameters
    ----------
    arm : Arm
    T : ndarray, shape (4, 4)
        Wanted pose in the world.
    tool : ndarray, shape (4, 4)
        The pose the tool has, in the world.

    Returns
    -------
    ndarray, shape (4, 4)
    """
    if arm.task.rotation == "full" and arm.task.position == "xyz":
        return np.array(T, dtype=np.float64)
    to_frame_0 = inverse(arm.base)
    wanted, present = to_frame_0 @ T, to_frame_0 @ tool
    p = present[:3, 3].copy()
    p[arm.task.coordinates] = wanted[arm.task.coordinates, 3]
    R = present[:3, :3]
    if arm.task.rotation in ("full", "approach"):
        R = wanted[:3, :3]
    elif arm.task.rotation == "phi":
        turn = wanted[:3, :3] @ R.T
        angle = math.atan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1])
        R = rotation_about("z", angle) @ R
    return np.array(arm.base @ transform(R, p), dtype=np.float64)
