"""Commands of the bench of velocities."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.velocity.speeds.state import FOLDS, MARKS, Velocity, Xyz, ends_of, usual_speed
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import setting
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SetSpeed(Command):
    """Set the speed of one joint; sent by a slider in motion.

    Parameters
    ----------
    joint : int
        0-based.
    value : float
        rad/s or m/s; moved inside the speed limits of the joint.
    """

    joint: int
    value: float
    units: ClassVar[Mapping[str, str]] = {"value_deg": "deg/s"}
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    @property
    def channel(self) -> object:
        """Keep the sliders of different joints from replacing each other."""
        return type(self), self.joint

    def apply(self, state: State) -> State:
        """Return the state with the speed."""
        part = state[Velocity]
        _check_joint(part, self.joint)
        qdot = list(part.qdot)
        qdot[self.joint] = self.value
        return setting(state, Velocity, {"qdot": qdot})


@dataclass(frozen=True)
class MoveAlone(Command):
    """Move one joint (0-based) alone, with its present speed or, if that is 0, its usual one."""

    joint: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with all other speeds 0."""
        part = state[Velocity]
        _check_joint(part, self.joint)
        speed = part.qdot[self.joint] or usual_speed(part.arm, self.joint)
        return setting(state, Velocity, {"qdot": [speed if i == self.joint else 0.0 for i in range(part.arm.n)]})


@dataclass(frozen=True)
class SetAllSpeeds(Command):
    """Let all joints stand still, or move each with its usual speed."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with all speeds 0, or all the usual ones."""
        arm = state[Velocity].arm
        return setting(state, Velocity, {"qdot": [usual_speed(arm, i) if self.on else 0.0 for i in range(arm.n)]})


@dataclass(frozen=True)
class LookAtLink(Command):
    """Look at the two ends of a link, 1 to n."""

    link: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the link and two of its points."""
        part = state[Velocity]
        looking = part.with_values({"link": self.link})
        if looking.link == part.link:
            return state
        return setting(state, Velocity, {"link": looking.link, "points": ends_of(part.arm, looking.link)})


@dataclass(frozen=True)
class SetLinkPoint(Command):
    """Place one of the two points of the link (0 or 1) in the axes of its frame, metres."""

    which: int
    xyz: Xyz
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the point placed."""
        refuse_beyond(self.which, 2, "point of a link")
        first, second = state[Velocity].points
        return setting(state, Velocity, {"points": (first, self.xyz) if self.which else (self.xyz, second)})


@dataclass(frozen=True)
class DrawVelocities(Command):
    """Draw or hide one of `armlab.benches.velocity.speeds.state.MARKS`."""

    name: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice."""
        return _switched(state, "marks", MARKS, self.name, self.on)


@dataclass(frozen=True)
class Unfold(Command):
    """Unfold or fold one of `armlab.benches.velocity.speeds.state.FOLDS`."""

    name: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice."""
        return _switched(state, "unfolded", FOLDS, self.name, self.on)


def _check_joint(part: Velocity, joint: int) -> None:
    if not 0 <= joint < part.arm.n:
        raise InputError(f"joint: expected 1 to {part.arm.n}, got {joint + 1}")


def _switched(state: State, field: str, known: Sequence[str], name: str, on: bool) -> State:
    """Return the state with one of the names of a field switched on or off."""
    known_name(field, name, known)
    chosen = getattr(state[Velocity], field)
    return setting(state, Velocity, {field: chosen | {name} if on else chosen - {name}})
