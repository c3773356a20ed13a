"""The part of joint 1 in the workspace: it turns or shifts, as a whole, what the other joints reach.

With q_1 = 0 the other joints reach a set of points. Joint 1 carries each of them along an arc, or along a line. So two
numbers u, v of a point do not depend on q_1, and a workspace is known from its section: which (u, v) are reached, and
at which third number s with q_1 = 0.

    joint 1 turns:  u = rho, the distance from its axis, v = z along it, s = the angle about it
    joint 1 slides: u, v = coordinates across its axis, s = the one along it
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.screws import screws_of

Floats = NDArray[np.float64]

SEED, SAMPLES = 4, 256
"""Seed and number of the random configurations that tell which joints move the tool point, and whether in a plane."""

STILL = 1e-9
"""Motion, relative to the reach, below which a point does not move."""

FULL_TURN = 1e-9
"""Angle, radians, that a range may lack of a whole turn and still be one."""


@dataclass(frozen=True, eq=False)
class FirstJoint:
    """Coordinates in which joint 1 changes one number alone.

    Attributes
    ----------
    arm : Arm
    revolute : bool
        Whether joint 1 turns.
    origin : ndarray, shape (3,)
        The point of the axis of joint 1 nearest to the origin of frame 0, in the world, metres; rho and v are 0 there.
    axes : ndarray, shape (3, 3)
        Columns in the world; the third lies along the axis of joint 1. For a planar arm with a prismatic first joint,
        the second one is the normal of its plane.
    moving : tuple of int
        0-based joints after the first that move the tool point, in order.
    planar : bool
        Whether the tool point stays in a plane; v then is the same everywhere.
    """

    arm: Arm
    revolute: bool
    origin: Floats
    axes: Floats
    moving: tuple[int, ...]
    planar: bool

    @property
    def low(self) -> float:
        """Lower limit of joint 1, rad or m."""
        return float(self.arm.limits[0, 0])

    @property
    def high(self) -> float:
        """Upper limit of joint 1, rad or m."""
        return float(self.arm.limits[0, 1])

    @property
    def full(self) -> bool:
        """Whether joint 1 turns all the way round."""
        return self.revolute and self.high - self.low >= math.tau - FULL_TURN

    def split(self, points: ArrayLike) -> Floats:
        """Return (u, v, s) of points.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            Points in the world, metres.

        Returns
        -------
        ndarray, shape (..., 3)
            Metres; s of a joint 1 that turns in radians, (-pi, pi].
        """
        local = (np.asarray(points, dtype=np.float64) - self.origin) @ self.axes
        if not self.revolute:
            return np.asarray(local)
        x, y = local[..., 0], local[..., 1]
        return np.stack([np.hypot(x, y), local[..., 2], np.arctan2(y, x)], axis=-1)

    def place(self, points: ArrayLike) -> Floats:
        """Return (u, v) of points (k, 3), shape (k, 2), as of `split`; without s it is found in half the time."""
        local = (np.asarray(points, dtype=np.float64) - self.origin) @ self.axes
        if not self.revolute:
            return np.asarray(local[:, :2])
        found = np.empty((len(local), 2))
        np.hypot(local[:, 0], local[:, 1], out=found[:, 0])
        found[:, 1] = local[:, 2]
        return found

    def join(self, coordinates: ArrayLike) -> Floats:
        """Return the points in the world (..., 3) with coordinates (u, v, s); the inverse of `split`."""
        given = np.asarray(coordinates, dtype=np.float64)
        if self.revolute:
            u, v, s = given[..., 0], given[..., 1], given[..., 2]
            given = np.stack([u * np.cos(s), u * np.sin(s), v], axis=-1)
        return np.asarray(self.origin + given @ self.axes.T)

    def measure(self, u: ArrayLike) -> Floats:
        """Return the length of path for a unit of s, metres: rho where joint 1 is revolute, else 1."""
        u = np.asarray(u, dtype=np.float64)
        return np.asarray(u if self.revolute else np.ones_like(u))


@lru_cache(maxsize=64)
def first_joint(arm: Arm) -> FirstJoint:
    """Return the coordinates of joint 1 of an arm (arms are compared by identity)."""
    screws = screws_of(arm)
    R, base = np.asarray(arm.base[:3, :3]), np.asarray(arm.base[:3, 3])
    axis = R @ screws.z[0]
    revolute = bool(arm.revolute[0])
    point = base + R @ screws.o[0]
    origin = point + axis * float(axis @ (base - point)) if revolute else base
    q = _configurations(arm)
    moves = np.linalg.norm(arm.jacobian(q)[:, :3, :], axis=1).max(axis=0) > STILL * (arm.reach or 1.0)
    moving = tuple(i for i in range(1, arm.n) if moves[i])
    points = np.asarray(arm.position(q), dtype=np.float64)
    still, second = STILL * (arm.reach or 1.0), None
    if revolute:
        # A plane in which the tool stays may be no plane across the axis: where joint 1 is locked, for one.
        planar = bool(np.ptp((points - origin) @ axis) <= still)
    else:
        planar, second = _plane_along(axis, points, still * SAMPLES)
    return FirstJoint(arm, revolute, np.asarray(origin), _frame(axis, second, R), moving, planar)


def _plane_along(axis: Floats, points: Floats, still: float) -> tuple[bool, Floats | None]:
    """Return whether points (k, 3) lie in a plane along an axis, and its normal (3,); None where many planes do.

    Seen along the axis they lie on a line then, or all at one place: no normal is needed that a locked joint, with
    points on a line or close to each other, would leave to rounding.
    """
    shifts = points - points.mean(axis=0)
    across = shifts - np.outer(shifts @ axis, axis)
    spread, directions = np.linalg.svd(across, full_matrices=False)[1:]
    planar = bool(spread[1] <= still)
    return planar, np.cross(axis, directions[0]) if planar and spread[0] > still else None


def _configurations(arm: Arm) -> Floats:
    rng = np.random.default_rng(SEED)
    low, high = arm.limits[:, 0], arm.limits[:, 1]
    return np.asarray(low + (high - low) * rng.random((SAMPLES, arm.n)))


def _frame(axis: Floats, second: Floats | None, R: Floats) -> Floats:
    """Return axes whose third is ``axis``; the second is near ``second``, or else the first near an axis of R."""
    if second is None:
        near = next(R[:, k] for k in range(3) if abs(R[:, k] @ axis) < 0.9)
        first = near - axis * (near @ axis)
    else:
        first = np.cross(second, axis)
    first = first / np.linalg.norm(first)
    return np.column_stack([first, np.cross(axis, first), axis])
