"""Two planar robots that face each other: where their bases stand, and what robot B is and has to do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, number, put, text, vector
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, PartType, State

Floats = NDArray[np.float64]
Two = tuple[float, float]

ROBOTS = {"A": "robot A", "B": "robot B"}

VERSIONS = {
    "three_links": "3R, pose",
    "two_links": "2R, pose",
    "two_links_position": "2R, position only",
}
"""Kinds of robot B: three links that have position and angle of the tool to reach, or two links with both, or with the
position alone."""

NONE = "none"
"""Key of the choice of no handle."""

ELBOWS = {"up": "elbow up", "down": "elbow down"}

FARTHEST = 50.0
"""Largest coordinate of a base, metres."""

SHORTEST, LONGEST = 0.01, 50.0
"""Least and largest length of a link of robot B, metres."""

LINK_A = 1.0
"""Length of both links of robot A, metres: only these give the numbers of 3.128."""

Q_A: Two = (math.pi / 3.0, -math.pi / 2.0)
"""Joint values of robot A at first, radians (notes 3.122)."""

BASE_A: Two = (-2.5, 1.0)
BASE_B: Two = (1.0, 2.0)
TURN_B = math.pi / 6.0
"""Places of both bases at first, metres, and the angle of the base of robot B, radians (notes 3.125-3.127)."""


@dataclass(frozen=True)
class TwoRobots(FieldPart):
    """Two robots, which do not depend on the arm.

    Attributes
    ----------
    q_a : (float, float)
        Joint values of robot A, radians.
    base_a, base_b : (float, float)
        x and y of the bases in the world, metres.
    turn_a, turn_b : float
        Angles of the bases about z, radians.
    between : float
        Angle about z from the tool of A to the tool of B, radians: pi where they point at each other.
    version : str
        A key of `VERSIONS`.
    link : float
        Length of each link of robot B, metres.
    elbow : "up" or "down"
        Solution in which robot B is drawn, if there are two.
    selected : "A", "B" or "none"
        Robot whose base has the handle.
    example : str
        Key of the example in place; empty if there is none.
    """

    key: ClassVar[str] = "two_robots"
    looks: ClassVar[tuple[str, ...]] = ("selected",)
    leave_example: ClassVar[tuple[str, ...]] = ("example", "elbow")

    q_a: Two = vector("q_A", "joint values of robot A", Q_A, -MOST_TURNED, MOST_TURNED, "rad")
    base_a: Two = vector("A", "base of robot A", BASE_A, -FARTHEST, FARTHEST, "m")
    turn_a: float = number("", "angle of the base of robot A", 0.0, -MOST_TURNED, MOST_TURNED, "rad")
    base_b: Two = vector("B", "base of robot B", BASE_B, -FARTHEST, FARTHEST, "m")
    turn_b: float = number("", "angle of the base of robot B", TURN_B, -MOST_TURNED, MOST_TURNED, "rad")
    between: float = number("", "angle between the tools", math.pi, -MOST_TURNED, MOST_TURNED, "rad")
    version: str = choice("kind of robot B", "three_links", VERSIONS)
    link: float = number("l", "length of the links of robot B", 1.0, SHORTEST, LONGEST, "m")
    elbow: str = choice("solution of robot B", "up", ELBOWS)
    selected: str = choice("robot with the handle", "B", ("A", "B", NONE))
    example: str = text("example", "three")

    def base(self, robot: str) -> Floats:
        """Return the pose of the base of robot A or B in the world, (4, 4)."""
        known_name("robot", robot, ROBOTS)
        (x, y), turn = (self.base_a, self.turn_a) if robot == "A" else (self.base_b, self.turn_b)
        return np.asarray(transform(rotation_about("z", turn), [x, y, 0.0]), dtype=np.float64)


PART = PartType(TwoRobots, order=131)


def _with(values: Two, index: int, value: float, what: str) -> Two:
    if index not in (0, 1):
        raise InputError(f"{what}: expected index 0 or 1, got {index}")
    return (value, values[1]) if index == 0 else (values[0], value)


def _changed(state: State, **values: Any) -> State:
    return put(state, state[TwoRobots].with_values(values).without_example())


def _of(robot: str, name: str) -> str:
    """Return the name of a field of robot A or B."""
    return f"{name}_{known_name('robot', robot, ROBOTS).lower()}"


@dataclass(frozen=True)
class SetRobotBase(Command):
    """Set x (0) or y (1) of the base of robot A or B in the world, metres."""

    robot: str
    axis: int
    value: float
    label: ClassVar[str] = "base of a robot"

    def apply(self, state: State) -> State:
        """Return the state with the base there."""
        name = _of(self.robot, "base")
        return _changed(state, **{name: _with(getattr(state[TwoRobots], name), self.axis, self.value, "base")})


@dataclass(frozen=True)
class TurnRobotBase(Command):
    """Set the angle of the base of robot A or B about z, radians."""

    robot: str
    value: float
    label: ClassVar[str] = "base of a robot"

    def apply(self, state: State) -> State:
        """Return the state with the base turned so."""
        return _changed(state, **{_of(self.robot, "turn"): self.value})


@dataclass(frozen=True)
class SetJointOfA(Command):
    """Set joint 1 (index 0) or joint 2 (index 1) of robot A, radians."""

    index: int
    value: float
    label: ClassVar[str] = "joint of robot A"

    def apply(self, state: State) -> State:
        """Return the state with the joint there."""
        return _changed(state, q_a=_with(state[TwoRobots].q_a, self.index, self.value, "joint"))


@dataclass(frozen=True, eq=False)
class DragRobotBase(Command):
    """Drag the handle of the base of a robot; this is one event of a drag.

    Parameters
    ----------
    robot : "A" or "B"
    pose : ndarray, shape (4, 4)
        In the world; only place and angle in the plane count.
    drag : object
        Which drag it belongs to; one drag is one step of undo.
    """

    robot: str
    pose: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a base"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragRobotBase, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the base there."""
        x, y = np.clip(self.pose[:2, 3], -FARTHEST, FARTHEST).tolist()
        turn = math.atan2(float(self.pose[1, 0]), float(self.pose[0, 0]))
        before = getattr(state[TwoRobots], _of(self.robot, "turn"))
        turn = before + math.remainder(turn - before, 2.0 * math.pi)
        return _changed(state, **{_of(self.robot, "base"): (x, y), _of(self.robot, "turn"): turn})
