"""The bench that solves for joint speeds: the wanted velocity of the tool, and the part of the task it concerns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number
from armlab.kin.task import Task
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, choice, own, setting, text, vector
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, PartType, State

CLIP_KEY = "self_motion"

ROWS = ("task", "position")
"""Choices of what is asked of the tool: all of its task, or the velocity of its point alone."""

FASTEST = 100.0
"""Largest speed that can be asked for, m/s or rad/s."""

USUAL = {"position": 0.25, "rotation": 0.0}
"""Initial velocity along the first coordinate, in length scales a second or rad/s."""


def _pair(data: Json) -> tuple[int, int]:
    first, second = (whole_number(each, "pair of joints", 0) for each in data)
    return first, second


def _start(data: Json) -> tuple[float, ...] | None:
    if data is None:
        return None
    return tuple(finite_floats(data, "start", (len(data),), "finite joint values").tolist())


@dataclass(frozen=True, eq=False)
class Solve(FieldPart):
    """The wanted velocity and the choices of the bench.

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
        Key of the loaded example; empty if it has been changed or there is none.
    """

    key: ClassVar[str] = "solve"
    kept_by_undo: ClassVar[bool] = True
    leave_example: ClassVar[tuple[str, ...]] = ("example", "rows", "pair", "start")

    arm: Arm
    twist: tuple[float, ...] = vector("v", "wanted velocity, m/s and rad/s", (), -FASTEST, FASTEST, kept="")
    rows: str = choice("what is asked of the tool", "task", ROWS, kept="")
    pair: tuple[int, int] = own("joints of the pictures, 0-based", (0, 1), _pair, kept="")
    start: tuple[float, ...] | None = own("where the self-motion began", None, _start, kept="")
    example: str = text("example", kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a moderate speed along the first coordinate of the task."""
        arm = robot.arm
        return cls(arm, usual_twist(arm), pair=(0, min(1, arm.n - 1)))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the velocity if the task is the same, and the joints of the pictures that are still there."""
        new = self.initial(robot)
        if robot.arm.task == self.arm.task:
            new = replace(new, twist=self.twist, rows=self.rows)
        kept = [origin.index(k) for k in self.pair if k in origin]
        return replace(new, pair=(kept[0], kept[1])) if len(set(kept)) == 2 else new

    def after(self, before: State, now: State) -> Self:
        """Forget the start of a self-motion when its clip is closed or the conditions on the tool have changed."""
        part = self
        if self.example and self is before[Solve] and now[Joints].q is not before[Joints].q:
            part = replace(part, example="")
        was, on = before[Timeline].clip == CLIP_KEY, now[Timeline].clip == CLIP_KEY
        other = self.rows != before[Solve].rows or now[Joints].locked != before[Joints].locked
        return replace(part, start=None) if (was or other) and not on and self.start is not None else part

    def check(self) -> None:
        """Refuse values that do not fit the arm."""
        n, (first, second) = self.arm.n, self.pair
        if self.rows == "position" and not has_choice(self.arm):
            raise InputError(f"position alone: the task of this arm is its {self.arm.task.title}")
        if (n > 1 or first or second) and (first == second or max(first, second) >= n):
            raise InputError(f"two joints: expected two different ones of 1 to {n}, got {first + 1} and {second + 1}")
        if self.start is not None and len(self.start) != n:
            raise InputError(f"start: expected {n} joint values, got {len(self.start)}")


PART = PartType(Solve, order=96)


def usual_twist(arm: Arm) -> tuple[float, ...]:
    """Return the velocity with which a bench begins, not above the largest that can be asked for."""
    twist = [0.0] * arm.task.m
    if arm.task.position:
        twist[0] = min(float(f"{USUAL['position'] * arm.length_scale:.1g}"), FASTEST)
    else:
        twist[0] = 0.5
    return tuple(twist)


@lru_cache(maxsize=64)
def position_only(arm: Arm) -> Arm:
    """Return the arm with the position of its tool point as its only task."""
    return replace(arm, task=Task(arm.task.position, "none"))


def arm_asked(state: State) -> Arm:
    """Return the arm with the chosen rows as its task."""
    part = state[Solve]
    return part.arm if part.rows == "task" else position_only(part.arm)


def has_choice(arm: Arm) -> bool:
    """Return whether the position alone is less than the task."""
    return bool(arm.task.position) and arm.task.rotation != "none"


@dataclass(frozen=True)
class SetComponent(Command):
    """Type one component of the wanted velocity, m/s or rad/s."""

    index: int
    value: float
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the velocity."""
        part = state[Solve]
        refuse_beyond(self.index, len(part.twist), "component")
        twist = list(part.twist)
        twist[self.index] = self.value
        return setting(state, Solve, {"twist": twist})


@dataclass(frozen=True)
class Aim(Command):
    """Drag the arrow of the wanted velocity: the components of the position, m/s; only the newest event counts."""

    velocity: tuple[float, ...]
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the velocity; its angular part stays."""
        part = state[Solve]
        p = len(part.arm.task.position)
        if len(self.velocity) != p:
            raise InputError(f"velocity: expected {p} components, got {len(self.velocity)}")
        return setting(state, Solve, {"twist": [*self.velocity, *part.twist[p:]]})


@dataclass(frozen=True)
class AskFor(Command):
    """Ask for the whole task or for the position alone."""

    rows: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with that choice."""
        return setting(state, Solve, {"rows": self.rows, "start": None})
