"""The arm on the table."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Self

from armlab.content.robots import OWN, Robot, catalogue, parse_robot
from armlab.content.write_robot import robot_toml
from armlab.errors import InputError
from armlab.kin.convert import Link, Remainders
from armlab.session.sizes import check_sizes
from armlab.session.state import Command, Json, Part, PartType, State


@dataclass(frozen=True)
class RobotPart(Part):
    """The arm in use: one of the files, or a table of the student's own.

    Attributes
    ----------
    robot : Robot
    origin : str
        Key of the file an own table began with; empty for one that began with none.
    moved : Remainders or None
        Parts that the last edit, a change of convention, put into base and tool; None after another edit.
    replaced : str
        Name of the arm that an example has taken from the table to put its own there; empty otherwise. Not saved.
    """

    key: ClassVar[str] = "robot"

    robot: Robot
    origin: str = ""
    moved: Remainders | None = None
    replaced: str = field(default="", compare=False)

    @property
    def own(self) -> bool:
        """Whether the table is edited by the student."""
        return self.robot.key == OWN

    @property
    def title(self) -> str:
        """The name of the arm, which says when it is no longer that of a file."""
        return f"{self.robot.name}, edited" if self.own and self.origin else self.robot.name

    def edits(self, before: RobotPart | None) -> bool:
        """Return whether this is the table of a part before, with edits."""
        if before is None or (before.origin, before.robot.name) != (self.origin, self.robot.name):
            return False
        return before.own or self.own

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part for an arm."""
        return cls(robot, "" if robot.key == OWN else robot.key)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part with the edited robot, and the key of the file from which the table began."""
        return type(self)(robot, self.origin)

    def to_json(self) -> Json:
        """Return the key of the file, or the whole of an edited table, as JSON."""
        if not self.own:
            return self.robot.key
        data: dict[str, Json] = {"toml": robot_toml(self.robot), "origin": self.origin}
        if self.moved is not None:
            data["moved"] = [[link.a, link.alpha] for link in (self.moved.base, self.moved.tool)]
            if not self.moved.task_kept:
                data["task_kept"] = False
        return data

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; the caller has found the robot by `robot_from_json`."""
        if not isinstance(data, dict):
            return cls(robot, robot.key)
        origin = data["origin"]
        moved = _moved(data.get("moved"), data.get("task_kept", True))
        return cls(robot, origin if origin in catalogue().robots else "", moved)


PART = PartType(RobotPart, order=0)


def _moved(data: Json, task_kept: Json) -> Remainders | None:
    if data is None:
        return None
    base, tool = ((float(a), float(alpha)) for a, alpha in data)
    if not all(map(math.isfinite, base + tool)) or not isinstance(task_kept, bool):
        raise InputError(f"moved: expected finite numbers, got {data}, {task_kept}")
    return Remainders(Link(*base), Link(*tool), task_kept)


def robot_from_json(data: Json) -> Robot:
    """Return the robot that saved data name or contain; raises when they are not usable."""
    if isinstance(data, dict):
        robot = parse_robot(OWN, data["toml"], proven=False)
        check_sizes(robot.arm)
        return robot
    return catalogue()[data]


@dataclass(frozen=True)
class ChooseRobot(Command):
    """Put another arm on the table, in its home pose."""

    key: str
    label: ClassVar[str] = "choice of arm"

    def apply(self, state: State) -> State:
        """Return the state with this arm, or the same state if it is there already."""
        robot = catalogue()[self.key]
        return state if robot is state[RobotPart].robot else state.with_robot(robot)
