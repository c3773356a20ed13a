"""An exercise of the assignment trainer: an arm in a pose where all joint axes lie along axes of the world."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot, catalogue
from armlab.kin.arm import Arm
from armlab.kin.assignment import Assignment, Choice, expected_table, judge_frames, own_choices
from armlab.kin.convert import converted
from armlab.kin.relations import axis_relations

Vector = NDArray[np.float64]
Axes = tuple[str, str]
"""The directions of z and x of one frame, out of `DIRECTIONS`; empty if none is chosen."""

DIRECTIONS = ("+x", "-x", "+y", "-y", "+z", "-z")

ALIGNED = 1e-6
"""Largest difference of an entry of a direction from 0 or ±1."""


def vector(direction: str) -> Vector:
    """Return the unit vector, in the world, of one of `DIRECTIONS`."""
    v = np.zeros(3)
    v["xyz".index(direction[1])] = -1.0 if direction[0] == "-" else 1.0
    return v


def choices_of(axes: tuple[Axes, ...]) -> tuple[Choice, ...]:
    """Return the student's choices as directions in the world."""
    return tuple(Choice(vector(z), vector(x)) for z, x in axes)


@dataclass(frozen=True, eq=False)
class Exercise:
    """Data of an exercise that depend on the arm alone.

    Attributes
    ----------
    robot : Robot
    """

    robot: Robot

    @property
    def n(self) -> int:
        """The number of joints."""
        return self.robot.arm.n

    @cached_property
    def q(self) -> Vector | None:
        """The pose in which the frames are placed, or None if no pose has all axes along those of the world."""
        return next((q for q in _poses(self.robot) if _is_aligned(self.robot.arm, q)), None)

    @property
    def usable(self) -> bool:
        """Whether the arm can be an exercise."""
        return self.q is not None

    @property
    def pose(self) -> Vector:
        """The pose in which the frames are placed, for a usable arm."""
        assert self.q is not None
        return self.q

    def same_as(self, other: Exercise) -> bool:
        """Return whether the same answers are right: rows in the standard convention, directions of frame 0, pose."""
        mine, theirs = (converted(exercise.robot.arm, "standard") for exercise in (self, other))
        if mine.rows != theirs.rows or not np.array_equal(mine.base[:3, :3], theirs.base[:3, :3]):
            return False
        return self.usable and other.usable and np.array_equal(self.pose, other.pose)

    @cached_property
    def solution(self) -> tuple[Axes, ...]:
        """Correct axes: those of the arm's own table if they lie along the world's."""
        own = own_choices(self.robot.arm, self.pose)
        return tuple(self._legal(own, i) for i in range(self.n + 1))

    def _legal(self, own: tuple[Choice, ...], i: int) -> Axes:
        z, x = _name(own[i].z), _name(own[i].x)
        if z and x:
            return z, x
        for axes in product((z,) if z else reversed(DIRECTIONS), (x,) if x else DIRECTIONS):
            trial = (*own[:i], *choices_of((axes,)), *own[i + 1 :])
            if judge_frames(self.robot.arm, self.pose, trial)[i].ok:
                return axes
        raise AssertionError("an aligned arm has legal axes")

    @cached_property
    def solved(self) -> Assignment:
        """The table and frames of the solution."""
        return expected_table(self.robot.arm, self.pose, choices_of(self.solution))

    @property
    def origins(self) -> Vector:
        """Origins of the solution by the rules, in the world, (n + 1, 3); only O_n depends on choices."""
        return self.solved.frames[:, :3, 3]

    @cached_property
    def own_frames(self) -> Vector:
        """The frames of the arm's own table, in the standard convention, in the world, (n + 1, 4, 4)."""
        return np.asarray(converted(self.robot.arm, "standard").frames(self.pose), dtype=np.float64)


@cache
def usable_robots() -> tuple[Robot, ...]:
    """Return the robots of the catalogue that can be exercises, the shortest first."""
    found = [robot for robot in catalogue().robots.values() if Exercise(robot).usable]
    return tuple(sorted(found, key=lambda robot: robot.arm.n))


def _poses(robot: Robot) -> Iterator[Vector]:
    """Yield poses to try: all joints at zero if possible, those of the file, then zero clipped to the limits."""
    zero = np.zeros(robot.arm.n)
    if robot.arm.within_limits(zero):
        yield zero
    for q in robot.poses.values():
        yield np.asarray(robot.arm.clip(q), dtype=np.float64)
    yield np.asarray(robot.arm.clip(zero), dtype=np.float64)


def _is_aligned(arm: Arm, q: Vector) -> bool:
    standard = converted(arm, "standard")
    frames, relations = standard.frames(q), axis_relations(standard)
    fixed = [frames[i, :3, 2] for i in range(arm.n)]
    fixed += [frames[i, :3, 0] for i in range(1, arm.n) if relations[i - 1].kind != "coincident"]
    return all(_name(v) for v in fixed)


def _name(direction: object) -> str:
    """Return the name of a direction along an axis of the world, or an empty text."""
    v = np.asarray(direction, dtype=np.float64)
    k = int(np.argmax(np.abs(v)))
    sign = float(np.sign(v[k]))
    return f"{'-' if sign < 0.0 else '+'}{'xyz'[k]}" if np.abs(v - sign * np.eye(3)[k]).max() <= ALIGNED else ""
