"""Homogeneous transforms. ``T_ab`` is the pose of frame b in frame a; neighbours cancel: ``T_ac = T_ab @ T_bc``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.rotations import Array, is_rotation


def transform(rotation: ArrayLike | None = None, position: ArrayLike | None = None) -> Array:
    """Return the 4 x 4 transform of a rotation (..., 3, 3) and a position (..., 3) in metres.

    Examples
    --------
    >>> transform(position=[1.0, 2.0, 3.0])[:3, 3].tolist()
    [1.0, 2.0, 3.0]
    """
    R = np.eye(3) if rotation is None else np.asarray(rotation, dtype=float)
    p = np.zeros(3) if position is None else np.asarray(position, dtype=float)
    batch = np.broadcast_shapes(R.shape[:-2], p.shape[:-1])
    T = np.zeros((*batch, 4, 4))
    T[..., :3, :3], T[..., :3, 3], T[..., 3, 3] = R, p, 1.0
    return T


def inverse(T: ArrayLike) -> Array:
    """Return the inverse of rigid transforms (..., 4, 4): R^T and -R^T p. Notes 3.115."""
    T = np.asarray(T, dtype=float)
    R_T = np.swapaxes(T[..., :3, :3], -1, -2)
    return transform(R_T, -(R_T @ T[..., :3, 3:])[..., 0])


def as_pose(T: ArrayLike, where: str) -> NDArray[np.float64]:
    """Return a checked, read-only copy of one rigid transform.

    Raises
    ------
    InputError
        Wrong shape, not finite, or the rotation is not orthonormal within 1e-6.
    """
    pose = as_floats(T, where, "a 4 x 4 matrix of numbers")
    if pose.shape != (4, 4):
        raise InputError(f"{where}: expected shape (4, 4), got {pose.shape}")
    if not np.isfinite(pose).all():
        raise InputError(f"{where}: every entry must be finite")
    if pose[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise InputError(f"{where}: the last row must be 0 0 0 1, got {pose[3].tolist()}")
    if not is_rotation(pose[:3, :3]):
        raise InputError(f"{where}: the upper left 3 x 3 block is not a rotation matrix")
    pose.setflags(write=False)
    return pose
