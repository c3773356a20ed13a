"""What can be done on the bench of velocities."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from armlab.benches.velocity.speeds.state import (
    FOLDS,
    MARKS,
    Velocity,
    Xyz,
    checked_point,
    ends_of,
    usual_speed,
    within,
)
from armlab.errors import InputError, UnknownName
from armlab.kin.velocity.jacobians import AXES
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SetSpeed(Command):
    """Set the speed of one joint: a slider in motion.

    Parameters
    ----------
    joint : int
        0-based.
    value : float
        rad/s or m/s; moved inside the speed limits of the joint.
    """

    joint: int
    value: float
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    @property
    def channel(self) -> object:
        """Sliders of different joints do not replace each other."""
        return type(self), self.joint

    def apply(self, state: State) -> State:
        """Return the state with the speed."""
        part = state[Velocity]
        _check_joint(part, self.joint)
        if not math.isfinite(self.value):
            raise InputError(f"speed of joint {self.joint + 1}: expected a number, got {self.value}")
        qdot = list(part.qdot)
        qdot[self.joint] = within(part.arm, self.joint, self.value)
        return _changed(state, qdot=tuple(qdot))


@dataclass(frozen=True)
class MoveAlone(Command):
    """Move one joint (0-based) alone, with the speed it has or, where it stands, its usual one."""

    joint: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with all other speeds 0."""
        part = state[Velocity]
        _check_joint(part, self.joint)
        speed = part.qdot[self.joint] or usual_speed(part.arm, self.joint)
        return _changed(state, qdot=tuple(speed if i == self.joint else 0.0 for i in range(part.arm.n)))


@dataclass(frozen=True)
class SetAllSpeeds(Command):
    """Let all joints stand still, or move each with its usual speed."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with all speeds 0, or all the usual ones."""
        arm = state[Velocity].arm
        return _changed(state, qdot=tuple(usual_speed(arm, i) if self.on else 0.0 for i in range(arm.n)))


@dataclass(frozen=True)
class WriteJacobianIn(Command):
    """Choose in whose axes J is written."""

    axes: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the axes."""
        if self.axes not in AXES:
            raise UnknownName("axes", self.axes, AXES)
        return _changed(state, axes=self.axes)


@dataclass(frozen=True)
class LookAtLink(Command):
    """Look at the two ends of a link, 1 to n."""

    link: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the link and its points."""
        part = state[Velocity]
        if not 1 <= self.link <= part.arm.n:
            raise InputError(f"link: expected 1 to {part.arm.n}, got {self.link}")
        if self.link == part.link:
            return state
        return _changed(state, link=self.link, points=ends_of(part.arm, self.link))


@dataclass(frozen=True)
class SetLinkPoint(Command):
    """Put one of the two points of the link (0 or 1) somewhere in the axes of its frame, metres."""

    which: int
    xyz: Xyz
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        if self.which not in (0, 1):
            raise InputError(f"point of a link: expected 1 or 2, got {self.which + 1}")
        first, second = state[Velocity].points
        point = checked_point(self.xyz)
        return _changed(state, points=(point, second) if self.which == 0 else (first, point))


@dataclass(frozen=True)
class DrawVelocities(Command):
    """Draw, or leave out, one of `armlab.benches.velocity.speeds.state.MARKS`."""

    name: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice."""
        if self.name not in MARKS:
            raise UnknownName("mark", self.name, MARKS)
        marks = state[Velocity].marks
        found = marks | {self.name} if self.on else marks - {self.name}
        return state if found == marks else state.replace(replace(state[Velocity], marks=found))


@dataclass(frozen=True)
class Unfold(Command):
    """Unfold, or fold away, one of `armlab.benches.velocity.speeds.state.FOLDS`."""

    name: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice."""
        if self.name not in FOLDS:
            raise UnknownName("part of the page", self.name, FOLDS)
        unfolded = state[Velocity].unfolded
        found = unfolded | {self.name} if self.on else unfolded - {self.name}
        return state if found == unfolded else state.replace(replace(state[Velocity], unfolded=found))


def _check_joint(part: Velocity, joint: int) -> None:
    if not 0 <= joint < part.arm.n:
        raise InputError(f"joint: expected 1 to {part.arm.n}, got {joint + 1}")


def _changed(state: State, **fields: Any) -> State:
    """Return the state with other values; what was an example is none any more."""
    part = state[Velocity]
    if all(getattr(part, name) == value for name, value in fields.items()):
        return state
    return state.replace(replace(part, **{"example": "", **fields}))
