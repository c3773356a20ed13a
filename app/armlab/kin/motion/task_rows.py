"""The components of twists, Jacobians and pose errors in an arm's task, for many configurations at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm

Floats = NDArray[np.float64]

FLOOR = 1e-13
"""Damping that keeps normal equations of a dimensionless Jacobian invertible; see `armlab.kin.ik.problem.FLOOR`."""


def task_rows(arm: Arm, columns: Floats, tool: Floats) -> Floats:
    """Return the controlled components of world twists.

    Parameters
    ----------
    arm : Arm
    columns : ndarray, shape (N, 6, k)
        Twists as columns: a Jacobian, or one twist with k = 1.
    tool : ndarray, shape (N, 4, 4)
        Poses of the tool; of an approach direction the rows are about its x and y axes.

    Returns
    -------
    ndarray, shape (N, m, k)
        In axes of frame 0, as the task defines them.
    """
    to_frame_0 = arm.base[:3, :3].T
    parts = [np.matmul(to_frame_0, columns[:, :3])[:, arm.task.coordinates]]
    if arm.task.rotation == "phi":
        parts.append(np.matmul(to_frame_0[2:], columns[:, 3:]))
    elif arm.task.rotation == "approach":
        parts.append(np.matmul(np.swapaxes(tool[:, :3, :2], 1, 2), columns[:, 3:]))
    elif arm.task.rotation == "full":
        parts.append(np.matmul(to_frame_0, columns[:, 3:]))
    return np.concatenate(parts, axis=1)


def scaled_jacobian(arm: Arm, q: Floats, tool: Floats) -> Floats:
    """Return dimensionless task Jacobians, (N, m, n): positions and prismatic joints in length scales."""
    # One configuration alone is much faster without the machinery of batches.
    whole = arm.jacobian(q[0])[None] if len(q) == 1 else arm.jacobian(q)
    J = task_rows(arm, np.asarray(whole, dtype=np.float64), tool)
    J[:, : len(arm.task.position)] /= arm.length_scale
    return J * joint_scales(arm)


def joint_scales(arm: Arm) -> Floats:
    """Return the size of one unit of each scaled joint variable, (n,), rad or m."""
    return np.where(arm.revolute, 1.0, arm.length_scale)


def scaled_rates(arm: Arm, twists: Floats, tool: Floats) -> Floats:
    """Return the controlled components of twists (N, 6), dimensionless, (N, m)."""
    rates = task_rows(arm, twists[:, :, None], tool)[:, :, 0]
    rates[:, : len(arm.task.position)] /= arm.length_scale
    return rates


def scaled_error(arm: Arm, tool: Floats, wanted: Floats) -> Floats:
    """Return the motion from tool to wanted poses (N, 4, 4) in controlled components, pure numbers, (N, m).

    For a rotation by theta about r it is 2 sin(theta/2) r, which grows up to a half turn.
    """
    if arm.task.rotation == "none":
        turn = np.zeros((len(tool), 3))
    elif arm.task.rotation == "full":
        sine = 0.5 * np.cross(tool[:, :3, :3], wanted[:, :3, :3], axis=1).sum(axis=2)
        turn = _chord(sine, 0.5 * (tool[:, :3, :3] * wanted[:, :3, :3]).sum(axis=(1, 2)) - 0.5)
    elif arm.task.rotation == "approach":
        # Only the third axes count: how the hand is turned about them is free.
        sine = np.cross(tool[:, :3, 2], wanted[:, :3, 2])
        turn = _chord(sine, (tool[:, :3, 2] * wanted[:, :3, 2]).sum(axis=1))
    else:
        up = arm.base[:3, :3]
        between = up.T @ wanted[:, :3, :3] @ np.swapaxes(tool[:, :3, :3], 1, 2) @ up
        angle = np.arctan2(between[:, 1, 0] - between[:, 0, 1], between[:, 0, 0] + between[:, 1, 1])
        turn = angle[:, None] * up[:, 2]
    return scaled_rates(arm, np.concatenate([wanted[:, :3, 3] - tool[:, :3, 3], turn], axis=1), tool)


def _chord(sine: Floats, cosine: Floats) -> Floats:
    """Return 2 sin(theta/2) r from sin(theta) r (N, 3) and cos(theta) (N,); finite at a half turn."""
    return np.asarray(sine / np.sqrt(np.maximum(0.5 + 0.5 * cosine, 1e-9))[:, None])


def least_squares(J: Floats, e: Floats, floor: float = FLOOR) -> Floats:
    """Return the shortest joint change with the least error, (N, n) from (N, m, n) and (N, m), by normal equations."""
    J_T = np.swapaxes(J, 1, 2)
    wide = J.shape[1] <= J.shape[2]
    normal = np.matmul(J, J_T) if wide else np.matmul(J_T, J)
    normal += floor * np.eye(normal.shape[1])
    if wide:
        return np.asarray(np.matmul(J_T, np.linalg.solve(normal, e[:, :, None]))[:, :, 0])
    return np.asarray(np.linalg.solve(normal, np.matmul(J_T, e[:, :, None]))[:, :, 0])
