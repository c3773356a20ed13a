"""The page of joint drives: gear, encoder and backlash of each joint of the arm."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.drive.joint_drives import LEAD, JointDrives, joint_drives
from armlab.kin.field import Field
from armlab.registry import known_name
from armlab.session.fields import FieldPart, flag, own, put, setting, text, vector
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Json, PartType, State

SIDES = {"motor": "motor", "joint": "joint"}
"""Sides of the gear on which an encoder may be."""

RATIO, COUNTS = 100.0, 4000.0
"""Ratio and counts in a turn at first."""

USUAL = "servo"
"""Key of the example that every joint has at first."""

LARGEST: dict[bool, float] = {True: math.radians(30.0), False: 0.1}
"""Largest backlash: of a joint that turns in rad, of one that slides in m."""

NUMBERS = {
    "ratio": Field("ratio", "n", "ratio of the gear", "number", RATIO, 0.0, 1e5, above=True),
    "counts": Field("counts", "N", "counts of the encoder in a turn", "whole", COUNTS, 1, 1e9),
    "backlash": Field("backlash", "", "backlash", "number", 0.0, 0.0, unit="q"),
    "lead": Field("lead", "p", "lead of the screw in a turn", "number", LEAD, 0.0, 1.0, above=True, unit="q"),
}
"""Numbers of each joint, by name."""


def number_of(arm: Arm, name: str, joint: int) -> Field:
    """Return a number of a joint (0-based), with its range; `UnknownName` for another name."""
    field = NUMBERS[known_name("number of a drive", name, NUMBERS)]
    high = LARGEST[bool(arm.revolute[joint])] if name == "backlash" else field.high
    return replace(field, title=f"{field.title} of joint {joint + 1}", high=high)


def _sides(data: Json) -> tuple[str, ...]:
    return tuple(known_name("encoder at", each, SIDES) for each in data)


@dataclass(frozen=True, eq=False)
class Drives(FieldPart):
    """Drives of the joints of the arm.

    Attributes
    ----------
    arm : Arm
    ratio, counts : tuple of float
        Turns of the motor for one behind the gear, and counts of the encoder in one turn of its shaft.
    side : tuple of "motor" or "joint"
        Where each encoder is.
    backlash : tuple of float
        Rad or m.
    lead : tuple of float
        Metres that a screw moves its joint in a turn; of joints that turn it means nothing.
    points : bool
        Whether the points by forward kinematics are drawn.
    example : str
        Key of the example in place; empty when something has been changed.
    """

    key: ClassVar[str] = "joint_drives"
    looks: ClassVar[tuple[str, ...]] = ("points",)

    arm: Arm
    ratio: tuple[float, ...] = vector("n", "ratio of each gear", kept="joints")
    counts: tuple[float, ...] = vector("N", "counts of each encoder in a turn", kept="joints")
    side: tuple[str, ...] = own("where each encoder is", (), _sides, kept="joints")
    backlash: tuple[float, ...] = vector("", "backlash of each joint, rad or m", kept="joints")
    lead: tuple[float, ...] = vector("p", "lead of each screw, m", kept="joints")
    points: bool = flag("points by forward kinematics", True)
    example: str = text("example", kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return every joint with the usual drive, without backlash."""
        n = robot.arm.n
        return cls(robot.arm, (RATIO,) * n, (COUNTS,) * n, ("motor",) * n, (0.0,) * n, (LEAD,) * n, example=USUAL)

    def check(self) -> None:
        """Refuse numbers out of range, and another number of sides than joints."""
        if len(self.side) != self.arm.n:
            raise InputError(f"side: expected {self.arm.n} sides, got {len(self.side)}")
        for name in NUMBERS:
            for i, value in enumerate(getattr(self, name)):
                _in_range(number_of(self.arm, name, i), value)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the drives of joints that are still there; one that turned and now slides gets no backlash."""
        new = super().for_edited(robot, origin)
        if new is self:
            return self
        before, now = self.arm.revolute, robot.arm.revolute
        backlash = [
            value if k is not None and before[k] == now[i] else 0.0
            for i, (value, k) in enumerate(zip(new.backlash, origin, strict=True))
        ]
        example = USUAL if self.example == USUAL else ""  # which joints that are added have, too
        return replace(new, backlash=tuple(backlash), example=example)

    @cached_property
    def drives(self) -> JointDrives:
        """The drives as arrays."""
        at_motor = [side == "motor" for side in self.side]
        return joint_drives(self.arm, self.ratio, self.counts, at_motor, self.backlash, self.lead)


PART = PartType(Drives, order=137)


def _in_range(field: Field, value: float) -> None:
    """Refuse a number of a joint; the sentence names both."""
    too_low = value <= field.low if field.above else value < field.low
    broken = field.kind == "whole" and value != round(value)
    if too_low or broken or value > field.high:
        unit = "" if field.unit == "1" else " rad or m"
        whole = "a whole number" if field.kind == "whole" else "a number"
        low = f"greater than {field.low:g} and at most" if field.above else f"from {field.low:g} to"
        raise InputError(f"{field.title}: expected {whole} {low} {field.high:g}{unit}, got {value:g}")


@dataclass(frozen=True)
class SetDrive(Command):
    """Set a number of the drive of one joint, 0-based: ratio, counts, backlash (rad or m) or lead (m)."""

    joint: int
    name: str
    value: float
    label: ClassVar[str] = "drive of a joint"

    def apply(self, state: State) -> State:
        """Return the state with this number."""
        part = state[Drives]
        _known_joint(part.arm, self.joint)
        number_of(part.arm, self.name, self.joint)
        return setting(state, Drives, {self.name: _with(getattr(part, self.name), self.joint, float(self.value))})


@dataclass(frozen=True)
class SetAllDrives(Command):
    """Set ratio or counts of all joints at once."""

    name: str
    value: float
    label: ClassVar[str] = "drives of all joints"

    def apply(self, state: State) -> State:
        """Return the state with this number for every joint."""
        known_name("number of all drives", self.name, ("ratio", "counts"))
        return setting(state, Drives, {self.name: (float(self.value),) * state[Drives].arm.n})


@dataclass(frozen=True)
class PlaceEncoder(Command):
    """Put the encoder of a joint, 0-based, on the shaft of the motor or on the joint."""

    joint: int
    side: str
    label: ClassVar[str] = "place of an encoder"

    def apply(self, state: State) -> State:
        """Return the state with the encoder there."""
        part = state[Drives]
        _known_joint(part.arm, self.joint)
        return setting(state, Drives, {"side": _with(part.side, self.joint, self.side)})


@dataclass(frozen=True)
class PlaceAllEncoders(Command):
    """Put the encoders of all joints on the shafts of the motors or on the joints."""

    side: str
    label: ClassVar[str] = "places of all encoders"

    def apply(self, state: State) -> State:
        """Return the state with all encoders there."""
        return setting(state, Drives, {"side": (self.side,) * state[Drives].arm.n})


def with_drives(state: State, part: Drives) -> State:
    """Return the state with other drives of the present arm."""
    return put(state, replace(part, arm=state[RobotPart].robot.arm))


def _known_joint(arm: Arm, joint: int) -> None:
    if not 0 <= joint < arm.n:
        raise InputError(f"joint: expected 1 to {arm.n}, got {joint + 1}")


def _with(values: tuple[Any, ...], index: int, value: Any) -> tuple[Any, ...]:
    return tuple(value if i == index else each for i, each in enumerate(values))
