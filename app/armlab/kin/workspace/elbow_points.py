"""The points that an elbow of three revolute joints reaches inside its limits, in closed form.

Joint 1 turns the plane in which the parallel joints 2 and 3 move the point; the plane may pass beside axis 1, and axis
2 may have any distance from it. A point is reached in up to four ways: facing it or backwards, elbow up or down.

References
----------
Notes 4.83-4.105; Siciliano et al., *Robotics*, 2.12.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.screws import Screws, screws_of
from armlab.kin.lines import PARALLEL_ANGLE
from armlab.kin.workspace.wrist_turns import within

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

BLOCK = 65_536
"""Points that are tested at once."""


@dataclass(frozen=True, eq=False)
class ElbowPoints:
    """The points that an elbow of three revolute joints reaches, in closed form.

    In the plane that joint 1 turns, complex numbers: ``w = shoulder + e^{i q2} (upper + e^{i q3} fore)``.

    Attributes
    ----------
    limits : ndarray, shape (3, 2)
    axes : ndarray, shape (3, 3)
        Axes in the world, as columns: in the plane outward, along axis 1, along axes 2 and 3.
    foot : ndarray, shape (3,)
        A point of axis 1 in the world, metres.
    beside : float
        Distance of the plane from axis 1, metres, with its sign along axis 2.
    shoulder, upper, fore : complex
        Metres.
    """

    limits: Floats
    axes: Floats
    foot: Floats
    beside: float
    shoulder: complex
    upper: complex
    fore: complex
    exact: bool = True

    @property
    def centre(self) -> Floats:
        """Centre (3,) of a ball around all reached points, on axis 1, metres, in the world."""
        return np.asarray(self.foot + self.axes[:, 1] * self.shoulder.imag)

    @property
    def radius(self) -> float:
        """Its radius, metres."""
        return math.hypot(abs(self.shoulder.real) + abs(self.upper) + abs(self.fore), self.beside)

    def holds(self, points: ArrayLike) -> Bools:
        """Return a mask of the points (..., 3) in the world, metres, that are reached."""
        given = np.asarray(points, dtype=np.float64)
        found = np.zeros(given.shape[:-1], dtype=bool)
        flat, out = given.reshape(-1, 3), found.reshape(-1)
        for start in range(0, len(flat), BLOCK):
            out[start : start + BLOCK] = self._holds(flat[start : start + BLOCK])
        return found

    def _holds(self, points: Floats) -> Bools:
        found = np.zeros(len(points), dtype=bool)
        for rows, q1, _, inside in self.ways(points):
            found[rows] |= inside & within(self.limits[0], q1)
        return found

    def ways(self, points: Floats) -> Iterator[tuple[Indices, Floats, Floats, Bools]]:
        """Yield up to four ways to reach points (k, 3) in the world.

        Yields
        ------
        rows : ndarray, shape (m,)
            Indices of the points.
        q1, bend : ndarray, shape (m,)
            Angles by which joint 1, and by which joints 2 and 3 together, turn the forearm, rad; see `forearm`.
        inside : ndarray of bool, shape (m,)
            Whether joints 2 and 3 can do so inside their limits; joint 1 is not asked.
        """
        local = (points - self.foot) @ self.axes
        ahead2 = local[:, 0] ** 2 + local[:, 2] ** 2 - self.beside**2
        rows = np.flatnonzero(ahead2 >= 0.0)
        ahead, height = np.sqrt(ahead2[rows]), local[rows, 1]
        # Turning about axis 1 by q1 takes the direction of axis 2 towards the outward one.
        bearing = local[rows, 2] + 1j * local[rows, 0]
        for facing in (ahead, -ahead):
            q1 = np.angle(bearing * np.conj(self.beside + 1j * facing))
            for q2, q3, real in self._bent(facing + 1j * height - self.shoulder):
                yield rows, q1, q2 + q3, real & within(self.limits[1], q2) & within(self.limits[2], q3)

    def forearm(self, q1: Floats, bend: Floats) -> Floats:
        """Return the rotation of the forearm in the world, relative to all joints at 0, shape (k, 3, 3)."""
        about = [_turns(self.axes[:, k], angle) for k, angle in ((1, q1), (2, bend))]
        return np.asarray(about[0] @ about[1])

    def _bent(self, w: NDArray[np.complex128]) -> list[tuple[Floats, Floats, Bools]]:
        """Return (q2, q3, whether the triangle closes) for both positions of the elbow."""
        upper, fore = abs(self.upper), abs(self.fore)
        cosine = (np.abs(w) ** 2 - upper**2 - fore**2) / (2.0 * upper * fore)
        real = np.abs(cosine) <= 1.0
        bend = np.arccos(np.clip(cosine, -1.0, 1.0))
        straight = float(np.angle(self.upper) - np.angle(self.fore))
        found = []
        for q3 in (straight + bend, straight - bend):
            q2 = np.angle(w * np.conj(self.upper + np.exp(1j * q3) * self.fore))
            found.append((q2, q3, real))
        return found


def _turns(axis: Floats, angles: Floats) -> Floats:
    """Return rotations (k, 3, 3) about a unit vector."""
    across = np.cross(np.eye(3), axis)
    c, s = np.cos(angles)[:, None, None], np.sin(angles)[:, None, None]
    return np.asarray(np.eye(3) + s * across + (1.0 - c) * (across @ across))


def elbow_of(arm: Arm) -> ElbowPoints | None:
    """Return the points that a three-joint elbow reaches; None when the arm is not one."""
    screws = screws_of(arm)
    if screws.kinds != "RRR" or not _is_elbow(screws):
        return None
    k, n = screws.z[0], screws.z[1]
    local = np.column_stack([np.cross(k, n), k, n])
    sign = float(np.sign(n @ screws.z[2]))
    o1, o2, o3, tip = (*screws.o, screws.home[:3, 3])
    shoulder, upper, fore = (complex(*(local[:, :2].T @ step)) for step in (o2 - o1, o3 - o2, tip - o3))
    if min(abs(upper), abs(fore)) <= PARALLEL_ANGLE * arm.length_scale:
        return None
    limits = arm.limits.copy()
    if sign < 0.0:
        limits[2] = -limits[2, ::-1]
    R, base = arm.base[:3, :3], arm.base[:3, 3]
    return ElbowPoints(limits, R @ local, base + R @ o1, float(n @ (tip - o1)), shoulder, upper, fore)


def _is_elbow(screws: Screws) -> bool:
    first, second, third = screws.z
    return abs(first @ second) <= PARALLEL_ANGLE and bool(np.linalg.norm(np.cross(second, third)) <= PARALLEL_ANGLE)
