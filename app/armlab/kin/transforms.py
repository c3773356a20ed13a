"""Homogeneous transforms. ``T_ab`` is the pose of frame b in frame a; neighbours cancel: ``T_ac = T_ab @ T_bc``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, together
from armlab.kin.rotations import Array, as_rotation


def transform(rotation: ArrayLike | None = None, position: ArrayLike | None = None) -> Array:
    """Return the 4 x 4 transform of a rotation (..., 3, 3) and a position (..., 3) in metres.

    Raises
    ------
    InputError
        The shapes do not fit.

    Examples
    --------
    >>> transform(position=[1.0, 2.0, 3.0])[:3, 3].tolist()
    [1.0, 2.0, 3.0]
    """
    R = np.eye(3) if rotation is None else as_floats(rotation, "rotation", "numbers of shape (..., 3, 3)")
    p = np.zeros(3) if position is None else as_floats(position, "position", "numbers of shape (..., 3)")
    if R.shape[-2:] != (3, 3) or p.shape[-1:] != (3,):
        raise InputError(
            f"transform: expected a rotation (..., 3, 3) and a position (..., 3), got {R.shape}, {p.shape}"
        )
    batch = together(rotation=R.shape[:-2], position=p.shape[:-1])
    T = np.zeros((*batch, 4, 4))
    T[..., :3, :3], T[..., :3, 3], T[..., 3, 3] = R, p, 1.0
    return T


def inverse(T: ArrayLike) -> Array:
    """Return the inverse of rigid transforms (..., 4, 4): R^T and -R^T p. Notes 3.115."""
    T = as_floats(T, "T", "numbers of shape (..., 4, 4)")
    if T.shape[-2:] != (4, 4):
        raise InputError(f"T: expected shape (..., 4, 4), got {T.shape}")
    R_T = np.swapaxes(T[..., :3, :3], -1, -2)
    return transform(R_T, -(R_T @ T[..., :3, 3:])[..., 0])


def as_pose(T: ArrayLike, where: str) -> NDArray[np.float64]:
    """Return a checked, read-only copy of one rigid transform; a rounded rotation is made a rotation.

    Three decimals are enough: the nearest rotation is taken, and `nearest_rotation` says how far off a matrix is.

    Raises
    ------
    InputError
        Wrong shape, not finite, or no rotation in the upper left 3 x 3 block, also no rounded one (`as_rotation`).
    """
    pose = as_floats(T, where, "a 4 x 4 matrix of numbers")
    if pose.shape != (4, 4):
        raise InputError(f"{where}: expected shape (4, 4), got {pose.shape}")
    if not np.isfinite(pose).all():
        raise InputError(f"{where}: every entry must be finite")
    if pose[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise InputError(f"{where}: the last row must be 0 0 0 1, got {pose[3].tolist()}")
    pose[:3, :3] = as_rotation(pose[:3, :3], f"{where}: the upper left 3 x 3 block")
    pose.setflags(write=False)
    return pose
