"""Where the tool may be when each joint is known only to within an interval.

Joint errors fill a box, ``|dq_i| <= h_i``. To first order the tool is off by ``dp = J_v dq`` and turned by
``dphi = J_w dq``, so that the box becomes a polytope, a zonotope, whose corners are among the images of the box's.
The length of a vector is a convex function, and the largest value of one over a box is at a corner: the worst case of
the first order is exact once all corners are looked at. Position and orientation are never added.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import MAX_JOINTS, Arm

Floats = NDArray[np.float64]


class Worst(NamedTuple):
    """The worst case of one block of the Jacobian.

    Attributes
    ----------
    size : float
        Largest error, m of a position, rad of an orientation.
    signs : ndarray, shape (n,)
        To which side each joint is off there: 1 or -1.
    vector : ndarray, shape (3,)
        The error there; its opposite is as large.
    """

    size: float
    signs: Floats
    vector: Floats


@cache
def corners(n: int) -> Floats:
    """Return the corners of the box from -1 to 1, shape (2^n, n), read-only; row k and row 2^n - 1 - k are opposite."""
    if not 1 <= n <= MAX_JOINTS:
        raise ValueError(f"corners: expected 1 to {MAX_JOINTS} joints, got {n}")
    found = np.asarray(1.0 - 2.0 * ((np.arange(2**n)[:, None] >> np.arange(n)) & 1), dtype=np.float64)
    found.setflags(write=False)
    return found


def inside(n: int, count: int, seed: int = 0) -> Floats:
    """Return random points of the box from -1 to 1, uniform, shape (count, n)."""
    return np.random.default_rng(seed).uniform(-1.0, 1.0, (count, n))


def worst(J: Floats, half: Floats) -> Worst:
    """Return the largest error of one block.

    Parameters
    ----------
    J : ndarray, shape (3, n)
        The rows of linear, or of angular, velocities; base axes.
    half : ndarray, shape (n,)
        Half width of the interval of each joint, rad or m.

    Examples
    --------
    >>> worst(np.array([[3.0, 1.0], [0.0, 0.0], [0.0, 0.0]]), np.array([1.0, 2.0])).size
    5.0
    """
    signs = corners(len(half))[: 2 ** (len(half) - 1)]  # the others are opposite to these
    vectors = (signs * half) @ J.T
    k = int(np.argmax(np.einsum("ki,ki->k", vectors, vectors)))
    return Worst(float(np.linalg.norm(vectors[k])), signs[k], vectors[k])


def shares(J: Floats, half: Floats) -> Floats:
    """Return the error that each joint causes by itself, ``|J_i| h_i``, m or rad, shape (n,); see `worst`."""
    return np.asarray(np.linalg.norm(J, axis=0) * half)


def by_jacobian(J: Floats, dq: Floats) -> tuple[Floats, Floats]:
    """Return the errors of position and orientation by a Jacobian (6, n), m and rad, shape (k, 3) each.

    ``dq`` holds joint errors, shape (k, n).
    """
    return np.asarray(dq @ J[:3].T), np.asarray(dq @ J[3:].T)


def by_kinematics(arm: Arm, q: Floats, dq: Floats) -> tuple[Floats, Floats]:
    """Return the same errors by forward kinematics of every configuration, without any approximation.

    The error of orientation is the axis of the rotation from the present one, times its angle.
    """
    here, there = arm.fk(q), arm.fk(q + dq)
    turned = np.asarray(there[:, :3, :3] @ here[:3, :3].T, dtype=np.float64)
    return np.asarray(there[:, :3, 3] - here[:3, 3]), _rotation_vectors(turned)


def _rotation_vectors(R: Floats) -> Floats:
    """Return axis times angle of rotations (k, 3, 3) that are less than half a turn, (k, 3)."""
    skew = 0.5 * np.stack(
        [R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]],
        axis=1,
    )
    sine = np.linalg.norm(skew, axis=1)
    angle = np.arctan2(sine, 0.5 * (np.trace(R, axis1=1, axis2=2) - 1.0))
    # angle/sine tends to 1 for small angles, where both are 0.
    factor = np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0.0)
    return np.asarray(factor[:, None] * skew)
