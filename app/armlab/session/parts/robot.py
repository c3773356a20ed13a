"""Which arm is on the table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot, catalogue
from armlab.session.state import Command, Json, Part, PartType, State


@dataclass(frozen=True)
class RobotPart(Part):
    """The robot file in use."""

    key: ClassVar[str] = "robot"

    robot: Robot

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part for an arm."""
        return cls(robot)

    def to_json(self) -> Json:
        """Write the key of the file."""
        return self.robot.key

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the part; the caller has already found the robot of this key."""
        return cls(robot)


PART = PartType(RobotPart, order=0)


@dataclass(frozen=True)
class ChooseRobot(Command):
    """Put another arm on the table, in its home pose."""

    key: str
    label: ClassVar[str] = "choice of arm"

    def apply(self, state: State) -> State:
        """Return the state with this arm, or the same state when it is already there."""
        robot = catalogue()[self.key]
        return state if robot is state[RobotPart].robot else state.with_robot(robot)
