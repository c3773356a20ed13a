"""The bench that solves for joint speeds: which velocity of the tool is wanted, and of how much of the task."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.task import Task
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, PartType, State

CLIP_KEY = "self_motion"

ROWS = ("task", "position")
"""What is asked of the tool: all of its task, or the velocity of its point alone."""

FASTEST = 100.0
"""m/s or rad/s; a faster tool is a slip of the pen."""

USUAL = {"position": 0.25, "rotation": 0.0}
"""Length scales a second, and rad/s, of the velocity a bench begins with, along its first coordinate."""


@dataclass(frozen=True, eq=False)
class Solve(Part):
    """What is asked for.

    Attributes
    ----------
    arm : Arm
    twist : tuple of float
        Wanted velocity of each component of the arm's task, m/s then rad/s, in the axes of the task.
    rows : "task" or "position"
    pair : tuple of two int
        The joints (0-based) of the pictures with two axes.
    start : tuple of float or None
        Where the arm stood when its self-motion was looked for; None while it was not.
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    """

    key: ClassVar[str] = "solve"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    twist: tuple[float, ...]
    rows: str = "task"
    pair: tuple[int, int] = (0, 1)
    start: tuple[float, ...] | None = None
    example: str = ""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a moderate speed along the first coordinate of the task."""
        arm = robot.arm
        return cls(arm, usual_twist(arm), pair=(0, min(1, arm.n - 1)))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the velocity where the task has stayed the same, and the joints of the pictures that are there."""
        new = self.initial(robot)
        if robot.arm.task == self.arm.task:
            new = replace(new, twist=self.twist, rows=self.rows)
        kept = [origin.index(k) for k in self.pair if k in origin]
        return replace(new, pair=(kept[0], kept[1])) if len(set(kept)) == 2 else new

    def after(self, before: State, now: State) -> Self:
        """Forget where a self-motion began when its clip is taken off, or what it leaves in place is another."""
        part = self
        if self.example and self is before[Solve] and now[Joints].q is not before[Joints].q:
            part = replace(part, example="")
        was, on = before[Timeline].clip == CLIP_KEY, now[Timeline].clip == CLIP_KEY
        other = self.rows != before[Solve].rows or now[Joints].locked != before[Joints].locked
        return replace(part, start=None) if (was or other) and not on and self.start is not None else part

    def to_json(self) -> Json:
        """Write what was chosen and typed."""
        return {
            "twist": list(self.twist),
            "rows": self.rows,
            "pair": list(self.pair),
            "start": None if self.start is None else list(self.start),
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it does not fit the arm."""
        arm = robot.arm
        twist = checked_twist(arm, [float(value) for value in data["twist"]])
        start = None if data["start"] is None else tuple(float(value) for value in data["start"])
        if start is not None and (len(start) != arm.n or not all(map(math.isfinite, start))):
            raise InputError(f"solve: expected {arm.n} finite joint values, got {start}")
        rows, (first, second), example = data["rows"], data["pair"], data.get("example", "")
        _check_rows(arm, rows)
        if not isinstance(example, str):
            raise InputError(f"solve, example: expected a key, got {example!r}")
        if not all(type(k) is int for k in (first, second)):
            raise InputError(f"solve, pair: expected two whole numbers, got {data['pair']}")
        if arm.n > 1 or (first, second) != (0, 0):
            _check_pair(arm, first, second)
        return cls(arm, twist, rows, (first, second), start, example)


PART = PartType(Solve, order=96)


def usual_twist(arm: Arm) -> tuple[float, ...]:
    """Return the velocity a bench begins with."""
    twist = [0.0] * arm.task.m
    if arm.task.position:
        twist[0] = float(f"{USUAL['position'] * arm.length_scale:.1g}")
    else:
        twist[0] = 0.5
    return tuple(twist)


def checked_twist(arm: Arm, twist: Sequence[float]) -> tuple[float, ...]:
    """Return a velocity; `InputError` when it is not one of the arm's task."""
    if len(twist) != arm.task.m:
        raise InputError(f"velocity: expected {arm.task.m} components ({arm.task.title}), got {len(twist)}")
    for value in twist:
        if not (math.isfinite(value) and abs(value) <= FASTEST):
            raise InputError(f"velocity: expected at most {FASTEST:g} m/s or rad/s, got {value:g}")
    return tuple(float(value) for value in twist)


@lru_cache(maxsize=64)
def position_only(arm: Arm) -> Arm:
    """Return the arm with the position of its tool point as its task; whatever else it could do is left free."""
    return replace(arm, task=Task(arm.task.position, "none"))


def arm_asked(state: State) -> Arm:
    """Return the arm with what is asked of it as its task."""
    part = state[Solve]
    return part.arm if part.rows == "task" else position_only(part.arm)


def has_choice(arm: Arm) -> bool:
    """Return whether position alone is less than the task."""
    return bool(arm.task.position) and arm.task.rotation != "none"


def _check_rows(arm: Arm, rows: str) -> None:
    if rows not in ROWS:
        raise UnknownName("what is asked", rows, ROWS)
    if rows == "position" and not has_choice(arm):
        raise InputError(f"position alone: the task of this arm is its {arm.task.title}")


def _check_pair(arm: Arm, first: int, second: int) -> None:
    if first == second or not (0 <= first < arm.n and 0 <= second < arm.n):
        raise InputError(f"two joints: expected two different ones of 1 to {arm.n}, got {first + 1} and {second + 1}")


@dataclass(frozen=True)
class SetComponent(Command):
    """Type one component of the wanted velocity, m/s or rad/s."""

    index: int
    value: float
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the velocity."""
        part = state[Solve]
        if not 0 <= self.index < len(part.twist):
            raise InputError(f"component: expected 1 to {len(part.twist)}, got {self.index + 1}")
        twist = list(part.twist)
        twist[self.index] = self.value
        return _with(state, replace(part, twist=checked_twist(part.arm, twist), example=""))


@dataclass(frozen=True)
class Aim(Command):
    """Drag the arrow of the wanted velocity: the components of the position, m/s; only the newest counts."""

    velocity: tuple[float, ...]
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the velocity; what turns stays."""
        part = state[Solve]
        p = len(part.arm.task.position)
        if len(self.velocity) != p:
            raise InputError(f"velocity: expected {p} components, got {len(self.velocity)}")
        twist = checked_twist(part.arm, [*self.velocity, *part.twist[p:]])
        return _with(state, replace(part, twist=twist, example=""))


@dataclass(frozen=True)
class AskFor(Command):
    """Ask for all of the task or for the position alone."""

    rows: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with that asked."""
        part = state[Solve]
        _check_rows(part.arm, self.rows)
        return _with(state, replace(part, rows=self.rows, start=None))


@dataclass(frozen=True)
class PicturePair(Command):
    """Choose the two joints (0-based) of the pictures."""

    first: int
    second: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the joints chosen."""
        part = state[Solve]
        _check_pair(part.arm, self.first, self.second)
        return _with(state, replace(part, pair=(self.first, self.second)))


def _with(state: State, part: Solve) -> State:
    before = state[Solve]
    same = all(getattr(part, name) == getattr(before, name) for name in ("twist", "rows", "pair", "start", "example"))
    return state if same else state.replace(part)
