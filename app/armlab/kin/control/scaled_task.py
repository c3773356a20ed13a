"""The task of an arm at successive configurations: its Jacobian, its error, and the scaling of metres and radians.

The components are those of `armlab.kin.ik.iterate.problem`, scaled as there: where metres and radians meet, lengths are
divided by the arm's length scale; where only one kind occurs, everything stays as it is.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.iterate.misfit import HALF_TURN_SINE, approach_error, rotation_vector, turn_about_z
from armlab.kin.ik.iterate.problem import Problem
from armlab.kin.ik.iterate.task_vector import TaskVector
from armlab.kin.joint_scale import jacobian_size
from armlab.kin.velocity.singular import usual_rank

Floats = NDArray[np.float64]

AT_IDENTITY = 1e-12
"""Sine of theta below which theta / (2 sin theta) is taken as its limit 1/2."""

ROUNDING = 1e-14
"""Largest entry of a scaled Jacobian, relative to its size in ordinary configurations, up to which all of it counts as
zero: the cosine of a right angle is 6e-17."""


class ScaledTask:
    """The task of an arm, in axes of frame 0.

    Parameters
    ----------
    arm : Arm

    Attributes
    ----------
    m, n : int
        Components of the task, and joints.
    row_units : ndarray, shape (m,)
        Factors from components in metres or radians to scaled ones.
    joint_units : ndarray, shape (n,)
        Factors from scaled joint changes to radians or metres.
    length : float
        Metres that count as 1: 1, or the arm's length scale where metres and radians meet.
    size : float
        Size of the scaled Jacobian in ordinary configurations.
    sigma_unit : str
        Unit of singular values of the scaled Jacobian: ``"m"`` or none.
    """

    def __init__(self, arm: Arm) -> None:
        some = np.asarray(arm.fk(arm.clip(np.zeros(arm.n))), dtype=np.float64)
        problem = Problem(arm, some, TaskVector(arm.task), range(arm.n), clamp=False)
        self.arm, self.m, self.n = arm, arm.task.m, arm.n
        self.row_units, self.joint_units = problem.row_units, problem.units
        self.length, self.sigma_unit = problem.length, problem.sigma_unit
        self.both = self.row_units[:, None] * self.joint_units
        self.size = jacobian_size(arm, self.joint_units, self.length)
        self._nothing = ROUNDING * self.size
        self._plain = bool(np.all(self.both == 1.0))
        self._turn = np.array(arm.base[:3, :3].T)
        self._places, self._place = len(arm.task.position), self._turn[arm.task.coordinates]
        self._rows = np.zeros((self.m, 6))
        self._rows[: self._places, :3] = self._place
        turns = {"none": np.eye(3)[:0], "phi": self._turn[2:], "approach": np.zeros((2, 3)), "full": self._turn}
        self._rows[self._places :, 3:] = turns[arm.task.rotation]
        self._follows_tool = arm.task.rotation == "approach"
        self._whole = bool(self.m == 6 and np.array_equal(self._rows, np.eye(6)))

    @cached_property
    def usual_rank(self) -> int:
        """Rank of the Jacobian where the arm is not singular: less than m and n for some arms and tasks."""
        return usual_rank(self.arm)

    def rows(self, R: Floats) -> Floats:
        """Return the matrix (m, 6) that takes a twist in world axes to the task; R (3, 3) is the tool's orientation."""
        if self._follows_tool:
            self._rows[self._places :, 3:] = R[:, :2].T
        return self._rows

    def pose(self, q: Floats) -> Floats:
        """Return the tool in the world, (4, 4)."""
        return np.asarray(self.arm.fk(q))

    def orientation(self, q: Floats) -> Floats:
        """Return the orientation of the tool, (3, 3), that `rows` and `jacobian` take; only some tasks need it."""
        return self.pose(q)[:3, :3] if self._follows_tool else self._turn

    def jacobian(self, q: Floats, R: Floats | None = None) -> Floats:
        """Return the task Jacobian (m, n) in metres and radians; R (3, 3), where it is known, saves its evaluation."""
        if self._whole:
            return np.asarray(self.arm.jacobian(q))
        if self._follows_tool and R is None:
            R = self.pose(q)[:3, :3]
        rows = self._rows if R is None else self.rows(R)
        return np.asarray(rows @ self.arm.jacobian(q))

    def scaled(self, J: Floats) -> Floats:
        """Return a task Jacobian (..., m, n) in scaled, dimensionless form; zero where all of it is rounding."""
        scaled = J if self._plain else np.asarray(J * self.both)
        nothing = np.abs(scaled).max(axis=(-2, -1)) <= self._nothing
        return np.where(nothing[..., None, None], 0.0, scaled) if nothing.any() else scaled

    def speeds(self, scaled: Floats) -> Floats:
        """Return joint speeds in rad/s and m/s from scaled ones, (..., n)."""
        return np.asarray(scaled * self.joint_units)

    def error(self, wanted: Floats, pose: Floats) -> Floats:
        """Return wanted minus present task (m,), metres and radians, of poses (4, 4) in the world.

        The orientation counts by theta r, the rotation vector from the present to the wanted orientation.
        """
        if self._whole:
            e = np.empty(6)
            e[:3] = wanted[:3, 3] - pose[:3, 3]
            e[3:] = turn_vector(wanted[:3, :3] @ pose[:3, :3].T)
            return e
        place, rotation = self._place @ (wanted[:3, 3] - pose[:3, 3]), self.arm.task.rotation
        if rotation == "none":
            return place
        e = np.empty(self.m)
        e[: self._places] = place
        if rotation == "full":
            e[self._places :] = self._turn @ turn_vector(wanted[:3, :3] @ pose[:3, :3].T)
        elif rotation == "phi":
            e[-1] = turn_about_z(self._turn @ wanted[:3, :3] @ pose[:3, :3].T @ self._turn.T)
        else:
            e[self._places :] = approach_error(pose[None, :3, :3], wanted[None, :3, :3])[0]
        return e

    def errors(self, wanted: Floats, poses: Floats) -> Floats:
        """Return the value of `error` for many poses (k, 4, 4), as (k, m)."""
        far = (wanted[:, :3, 3] - poses[:, :3, 3]) @ self._place.T
        R, goal, rotation = poses[:, :3, :3], wanted[:, :3, :3], self.arm.task.rotation
        turn = np.zeros((len(poses), 0))
        if rotation == "full":
            turn = rotation_vector(goal @ np.swapaxes(R, 1, 2)) @ self._turn.T
        elif rotation == "phi":
            turn = turn_about_z(self._turn @ goal @ np.swapaxes(R, 1, 2) @ self._turn.T)[:, None]
        elif rotation == "approach":
            turn = approach_error(R, goal)
        return np.concatenate([far, turn], axis=1)

    def jacobians(self, q: Floats, poses: Floats) -> Floats:
        """Return the scaled task Jacobians (k, m, n) at configurations (k, n) with tool poses (k, 4, 4)."""
        whole = np.asarray(self.arm.jacobian(q), dtype=np.float64)
        rows: Floats = self._rows[None]
        if self._follows_tool:
            rows = np.repeat(rows, len(q), axis=0)
            rows[:, self._places :, 3:] = np.swapaxes(poses[:, :3, :2], 1, 2)
        return self.scaled(np.asarray(rows @ whole))

    def kinds(self, components: Floats) -> tuple[Floats, Floats]:
        """Return the norms of the parts in metres and in radians of task vectors (..., m), shape (...) each."""
        place, turn = components[..., : self._places], components[..., self._places :]
        return np.linalg.norm(place, axis=-1), np.linalg.norm(turn, axis=-1)


def turn_vector(R: Floats) -> Floats:
    """Return theta r (3,), angle times axis, of one rotation (3, 3), with theta in [0, pi]."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = R.tolist()
    x, y, z = zy - yz, xz - zx, yx - xy
    sine, cosine = 0.5 * math.sqrt(x * x + y * y + z * z), 0.5 * (xx + yy + zz - 1.0)
    if cosine < 0.0 and sine < HALF_TURN_SINE:
        return rotation_vector(R)
    factor = 0.5 if sine < AT_IDENTITY else 0.5 * math.atan2(sine, cosine) / sine
    return np.array([factor * x, factor * y, factor * z])
