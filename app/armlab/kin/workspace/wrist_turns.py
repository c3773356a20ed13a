"""The directions into which a spherical wrist can turn the tool with the forearm at rest, within its joint limits.

The direction from the wrist centre to the tool point is d = E_4(q_4) E_5(q_5) E_6(q_6) t, in axes fixed to the forearm.
Where the tool point lies on axis 6 the last turn does nothing: two values of q_5 give the angle between d and axis 4,
and each of them one q_4. Else q_6 is tried all along its range.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.screws import rotation, screws_of
from armlab.kin.lines import PARALLEL_ANGLE
from armlab.kin.work import Work, result_of
from armlab.kin.workspace.first_joint import FULL_TURN
from armlab.kin.wrist import wrist_centre

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

ROLLS = 180
"""Number of values of q_6 that are tried when the tool point is not on axis 6."""

STRIDE = 67
"""Step among these values from one to the next; it has no common divisor with their number."""

NO_TOOL = 1e-9
"""Distance, metres, below which the tool point is the wrist centre."""

TRIED = 6144
"""Directions that are tried with one value of q_6 in one piece of work."""

SIDE = 56
"""Cells along a side of the cube that holds a table over the sphere: less than two degrees each."""


@dataclass(frozen=True, eq=False)
class WristTurns:
    """The last three joints of an arm.

    Attributes
    ----------
    axes : ndarray, shape (3, 3)
        Rows: unit vectors along axes n-2, n-1 and n with all joints at 0, in the world.
    tool : ndarray, shape (3,)
        Unit vector from the wrist centre to the tool point there; along the tool's z axis where the two are one.
    length : float
        Distance of the tool point from the wrist centre, metres.
    limits : ndarray, shape (3, 2)
        Radians.
    free : bool
        Whether every orientation is possible.
    """

    axes: Floats
    tool: Floats
    length: float
    limits: Floats
    free: bool

    @cached_property
    def rolls(self) -> Floats:
        """Values of the last joint that are tried, rad, in an order with large steps, so that a few usually decide."""
        low, high = self.limits[2]
        if np.linalg.norm(np.cross(self.axes[2], self.tool)) <= PARALLEL_ANGLE:
            return np.array([low])
        return np.linspace(low, high, ROLLS)[np.arange(ROLLS) * STRIDE % ROLLS]

    def allows(self, directions: ArrayLike) -> Bools:
        """Return a mask of the unit vectors (..., 3) that are possible, in world axes with the forearm as at q = 0."""
        d = np.asarray(directions, dtype=np.float64)
        return result_of(self._trying(d.reshape(-1, 3))).reshape(d.shape[:-1])

    def _trying(self, d: Floats) -> Work[Bools]:
        """Return, in pieces of work, which unit vectors (k, 3) are possible."""
        found = np.zeros(len(d), dtype=bool)
        for roll in self.rolls:
            t = rotation(self.axes[2], roll) @ self.tool
            left = np.flatnonzero(~found)
            for first in range(0, len(left), TRIED):
                some = left[first : first + TRIED]
                found[some] = self._reaches(t, d[some])
                yield
        return found

    def _reaches(self, t: Floats, d: Floats) -> Bools:
        """Return the unit vectors (k, 3), as a mask, into which the first two joints can turn t (3,)."""
        first, second, _ = self.axes
        along, across = second * (second @ t), np.cross(second, t)
        x, y = float(first @ (t - along)), float(first @ across)
        size, found = math.hypot(x, y), np.zeros(len(d), dtype=bool)
        if size <= PARALLEL_ANGLE:
            return found
        height = d @ first
        cosine = (height - first @ along) / size
        bend = np.arccos(np.clip(cosine, -1.0, 1.0))
        for q5 in (math.atan2(y, x) + bend, math.atan2(y, x) - bend):
            w = along + np.cos(q5)[:, None] * (t - along) + np.sin(q5)[:, None] * across
            beside = np.cross(w, d) @ first
            ahead = np.einsum("ki,ki->k", w, d) - (w @ first) * height
            q4 = np.arctan2(beside, ahead)
            found |= (np.abs(cosine) <= 1.0) & within(self.limits[1], q5) & within(self.limits[0], q4)
        return found

    @cached_property
    def table(self) -> Bools:
        """Values of `allows` in the cells of a cube about the sphere, flat; see `looked_up`."""
        return result_of(self._tabulating())

    def preparing(self) -> Work[None]:
        """Make the table in pieces of at most some 20 ms, unless it exists."""
        if "table" not in self.__dict__:
            self.__dict__["table"] = yield from self._tabulating()

    def _tabulating(self) -> Work[Bools]:
        middle = (np.arange(SIDE) + 0.5) * (2.0 / SIDE) - 1.0
        cells = np.stack(np.meshgrid(middle, middle, middle, indexing="ij"), axis=-1).reshape(-1, 3)
        length = np.linalg.norm(cells, axis=1)
        near = np.flatnonzero(np.abs(length - 1.0) <= 2.0 / SIDE)
        table = np.zeros(len(cells), dtype=bool)
        yield
        table[near] = yield from self._trying(cells[near] / length[near, None])
        return table

    def looked_up(self, directions: NDArray[np.floating]) -> Bools:
        """Return approximately the result of `allows`, from the table, for unit vectors (3, ...), components first."""
        at = np.minimum((directions * (0.5 * SIDE) + 0.5 * SIDE).astype(np.int32), SIDE - 1)
        return np.asarray(self.table[(at[0] * SIDE + at[1]) * SIDE + at[2]])


def within(limits: Floats, q: Floats) -> Bools:
    """Return which angles are inside the limits (low, high) of a joint, up to whole turns."""
    low, high = limits
    if high - low >= math.tau - FULL_TURN:
        return np.ones(q.shape, dtype=bool)
    return np.asarray(np.mod(q - low, math.tau) <= high - low)


def turns_freely(arm: Arm) -> bool:
    """Return whether the limits of the last three joints let a spherical wrist take every orientation.

    Its outer joints turn all the way round, and the middle one makes every angle between their axes.
    """
    first, second, third = screws_of(arm).z[-3:]
    spans = arm.limits[-3:, 1] - arm.limits[-3:, 0]
    if min(spans[0], spans[2]) < math.tau - FULL_TURN:
        return False
    low, high = arm.limits[-2]
    along = (first @ second) * (second @ third)
    across = third - second * (second @ third)
    x, y = float(first @ across), float(first @ np.cross(second, across))
    # The cosine of the angle between the outer axes is along + x cos q + y sin q: extreme at the limits, or where its
    # derivative is zero.
    turn = math.atan2(y, x)
    steps = np.arange(math.ceil((low - turn) / math.pi), math.floor((high - turn) / math.pi) + 1)
    q = np.array([low, high, *(turn + math.pi * steps)])
    cosine = along + x * np.cos(q) + y * np.sin(q)
    return bool(cosine.min() <= PARALLEL_ANGLE - 1.0 and cosine.max() >= 1.0 - PARALLEL_ANGLE)


def wrist_turns(arm: Arm) -> WristTurns:
    """Return the wrist of an arm whose last three axes meet."""
    centre = wrist_centre(arm)
    assert centre is not None
    home, length = arm.fk(np.zeros(arm.n)), float(np.linalg.norm(centre))
    tool = home[:3, 2] if length <= NO_TOOL else -home[:3, :3] @ centre / length
    return WristTurns(
        screws_of(arm).z[-3:] @ arm.base[:3, :3].T, np.asarray(tool), length, arm.limits[-3:], turns_freely(arm)
    )
