"""The joint values, and the joints that are held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Json, Part, PartType, State


@dataclass(frozen=True, eq=False)
class Joints(Part):
    """A configuration of the arm.

    Attributes
    ----------
    arm : Arm
        The arm of the robot part.
    q : ndarray, shape (n,)
        Radians and metres, inside the limits, read-only.
    locked : tuple of bool
        Joints that neither inverse kinematics nor a named pose may move.
    draws : int
        Number of random poses so far: the seed of the next.
    """

    key: ClassVar[str] = "joints"

    arm: Arm
    q: NDArray[np.float64]
    locked: tuple[bool, ...]
    draws: int = 0

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the home pose with no joint held."""
        return cls(robot.arm, _checked(robot.arm, robot.home), (False,) * robot.arm.n)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part with values and locks of remaining joints; added ones take the values of the robot's home."""
        q, locked = np.array(robot.home), [False] * robot.arm.n
        for i, before in enumerate(origin):
            if before is not None and self.arm.rows[before].kind == robot.arm.rows[i].kind:
                q[i], locked[i] = self.q[before], self.locked[before]
        return type(self)(robot.arm, _checked(robot.arm, q), tuple(locked), self.draws)

    def to_json(self) -> Json:
        """Return values and locks as JSON."""
        return {"q": self.q.tolist(), "locked": list(self.locked), "draws": self.draws}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return values and locks from JSON; values outside changed limits are moved inside."""
        locked = tuple(bool(held) for held in data["locked"])
        if len(locked) != robot.arm.n:
            raise InputError(f"locked: expected {robot.arm.n} entries, got {len(locked)}")
        draws = int(data["draws"])
        if draws < 0:
            raise InputError(f"draws: expected 0 or more, got {draws}")
        return cls(robot.arm, _checked(robot.arm, data["q"]), locked, draws)

    def moved_to(self, q: ArrayLike) -> Self:
        """Return the part with these joint values moved inside the limits; held joints stay."""
        wanted = _checked(self.arm, q)
        values = np.where(self.locked, self.q, wanted)
        values.setflags(write=False)
        return self if np.array_equal(values, self.q) else replace(self, q=values)

    def freed_at(self, q: ArrayLike) -> Self:
        """Return the part with no joint held, at these joint values moved inside the limits."""
        return replace(self, locked=(False,) * self.arm.n).moved_to(q)

    @cached_property
    def tool_pose(self) -> NDArray[np.floating]:
        """The pose of the tool in the world, (4, 4)."""
        return self.arm.fk(self.q)

    @cached_property
    def frames(self) -> NDArray[np.floating]:
        """Frames 0 to n in the world, (n+1, 4, 4)."""
        return self.arm.frames(self.q)

    @cached_property
    def manipulability(self) -> float:
        """The manipulability w of the task."""
        return float(self.arm.manipulability(self.q))


def of_its_kind(values: Sequence[float], before: Arm, robot: Robot, origin: Sequence[int | None]) -> tuple[float, ...]:
    """Return joint values with those of the robot's home for joints that turned and now slide, or the reverse.

    Radians are no metres.

    Parameters
    ----------
    values : sequence of float, shape (n,)
        Of the edited arm, rad or m.
    before : Arm
        The arm before the edit.
    robot : Robot
        The edited one.
    origin : sequence of int or None
        For each joint of the edited arm, its index before; None for an added one.
    """
    joints = zip(values, origin, robot.arm.revolute, robot.home, strict=True)
    return tuple(
        float(home if k is not None and before.revolute[k] != turns else value) for value, k, turns, home in joints
    )


PART = PartType(Joints, order=10)


@dataclass(frozen=True)
class MoveJoint(Command):
    """Move one joint: a slider in motion."""

    joint: int
    value: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "joint motion"

    @property
    def channel(self) -> object:
        """The joint: sliders of different joints do not replace each other."""
        return type(self), self.joint

    def apply(self, state: State) -> State:
        """Return the state with the joint at the value, or at its limit."""
        joints = state[Joints]
        if not 0 <= self.joint < joints.arm.n:
            raise InputError(f"joint: expected 1 to {joints.arm.n}, got {self.joint + 1}")
        q = joints.q.copy()
        q[self.joint] = self.value
        return _with(state, joints.moved_to(q))


@dataclass(frozen=True)
class TypeJoint(MoveJoint):
    """Move one joint to a typed value, which is a step of undo of its own."""

    snapshot: ClassVar[bool] = False
    rests: ClassVar[bool] = False
    label: ClassVar[str] = "joint value"


@dataclass(frozen=True)
class TakePose(Command):
    """Go to a named pose of the robot file, or to ``zero``: every joint at 0 or at the limit nearest to it."""

    name: str
    label: ClassVar[str] = "move"

    def apply(self, state: State) -> State:
        """Return the state in this pose."""
        poses = state[RobotPart].robot.poses
        if self.name in poses:
            q = poses[self.name]
        elif self.name == "zero":
            q = np.zeros(state[Joints].arm.n)
        else:
            raise UnknownName("pose", self.name, {*poses, "zero"})
        return _with(state, state[Joints].moved_to(q))


@dataclass(frozen=True)
class RandomPose(Command):
    """Go to a random configuration inside the limits, which is the same after the same history."""

    label: ClassVar[str] = "random pose"

    def apply(self, state: State) -> State:
        """Return the state in the next random pose."""
        joints = state[Joints]
        q = np.random.default_rng(joints.draws).uniform(joints.arm.limits[:, 0], joints.arm.limits[:, 1])
        return _with(state, replace(joints.moved_to(q), draws=joints.draws + 1))


@dataclass(frozen=True)
class LockJoint(Command):
    """Hold a joint where it is, or release it."""

    joint: int
    locked: bool
    label: ClassVar[str] = "lock"

    def apply(self, state: State) -> State:
        """Return the state with the joint held or free."""
        joints = state[Joints]
        locked = tuple(self.locked if i == self.joint else held for i, held in enumerate(joints.locked))
        return state if locked == joints.locked else state.replace(replace(joints, locked=locked))


def _with(state: State, joints: Joints) -> State:
    return state if joints is state[Joints] else state.replace(joints)


def _checked(arm: Arm, q: ArrayLike) -> NDArray[np.float64]:
    values = np.array(q, dtype=float)
    if values.shape != (arm.n,) or not np.all(np.isfinite(values)):
        raise InputError(f"q: expected {arm.n} finite numbers, got {values.tolist()}")
    inside: NDArray[np.float64] = np.array(arm.clip(values), dtype=np.float64)
    inside.setflags(write=False)
    return inside
