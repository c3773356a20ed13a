"""The pose that the table task asks of the arm, and how far its tool is from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.table.state import task_of
from armlab.kin.rotations import axis_angle
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Asked:
    """The pose that is asked of the arm, beside where its tool is.

    Attributes
    ----------
    T_be : ndarray, shape (4, 4)
        The wanted tool in the base of the arm.
    away : float
        Distance of the tool from there, metres.
    turned : float
        Angle between the orientations, radians.
    """

    T_be: Floats
    away: float
    turned: float


def asked_of(state: State) -> Asked:
    """Return the pose that is asked of the arm."""
    joints, wanted = state[Joints], task_of(state).T_we
    tool = np.asarray(joints.tool_pose, dtype=np.float64)
    turned = float(axis_angle(tool[:3, :3].T @ wanted[:3, :3])[1])
    away = float(np.linalg.norm(tool[:3, 3] - wanted[:3, 3]))
    return Asked(np.asarray(inverse(joints.arm.base) @ wanted), away, turned)
