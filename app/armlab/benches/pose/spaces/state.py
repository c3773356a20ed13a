"""The page of spaces: what r describes, the end of a stick, and how a planar 3R is described."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.kin.representations import nearest_stick_end, stick_angle, stick_end, stick_residual
from armlab.session.fields import FieldPart, choice, number, setting, text
from armlab.session.state import Command, PartType, State

SHOWN = {"maps": "1 Three spaces", "stick": "2 Pendulum", "arms": "3 Two arms"}

TASKS = {
    "own": "the task of the arm",
    "xy": "p_x, p_y",
    "xy phi": "p_x, p_y, φ",
    "xyz": "p_x, p_y, p_z",
    "xyz approach": "position, direction",
    "pose": "position, orientation",
}
"""Tasks that r may describe, key to words."""

BY = {"xy": "its end", "theta": "its angle"}
"""Representations of the stick."""

DESCRIBED = {"joint3": "joint 3 and q₃", "tool": "tool and φ"}
"""Descriptions of a planar 3R."""

FARTHEST, SHORTEST, LONGEST = 10.0, 0.05, 5.0
"""Largest coordinate of the end of the stick, and limits of its length, metres."""


@dataclass(frozen=True)
class Spaces(FieldPart):
    """Choices of the page.

    Attributes
    ----------
    shown : "maps", "stick" or "arms"
    task : str
        What r describes; "own" for the task of the arm.
    by : "xy" or "theta"
        Numbers by which the stick is moved.
    x, y : float
        End of the stick, metres; possibly where the stick cannot end.
    length : float
        Metres.
    described : "joint3" or "tool"
        Numbers by which the planar 3R is described.
    example : str
    """

    key: ClassVar[str] = "spaces"
    looks: ClassVar[tuple[str, ...]] = ("shown",)

    shown: str = choice("what is shown of the spaces", "maps", SHOWN)
    task: str = choice("what r describes", "own", TASKS)
    by: str = choice("representation of the stick", "xy", BY)
    x: float = number("p_x", "p_x of the end", 0.6, -FARTHEST, FARTHEST, "m")
    y: float = number("p_y", "p_y of the end", -0.8, -FARTHEST, FARTHEST, "m")
    length: float = number("L", "length of the stick", 1.0, SHORTEST, LONGEST, "m")
    described: str = choice("description of the arm", "joint3", DESCRIBED)
    example: str = text("example")

    @property
    def residual(self) -> float:
        """How far the end is from fulfilling the constraint, m²."""
        return stick_residual(self.x, self.y, self.length)

    @property
    def theta(self) -> float:
        """The angle of the end from straight down, radians."""
        return stick_angle(self.x, self.y)


PART = PartType(Spaces, order=44)


@dataclass(frozen=True)
class MoveEnd(Command):
    """Move the end of the stick to a point; where theta represents it, to the nearest one where it can be.

    Parameters
    ----------
    x, y : float
        Metres.
    """

    x: float
    y: float
    label: ClassVar[str] = "end of the stick"

    def apply(self, state: State) -> State:
        """Return the state with the end there."""
        part = state[Spaces]
        end = (self.x, self.y) if part.by == "xy" else nearest_stick_end(self.x, self.y, part.length)
        return setting(state, Spaces, dict(zip("xy", end, strict=True)))


@dataclass(frozen=True)
class DragEnd(MoveEnd):
    """Drag the end of the stick; this is one event of a drag.

    Parameters
    ----------
    drag : int
        Which drag it belongs to: one drag is one step of undo.
    """

    drag: int = 0
    snapshot: ClassVar[bool] = True

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragEnd, self.drag


@dataclass(frozen=True)
class TurnStick(Command):
    """Turn the stick to an angle from straight down, which is always possible.

    Parameters
    ----------
    theta : float
        Radians, counter-clockwise.
    """

    theta: float
    label: ClassVar[str] = "angle of the stick"

    def apply(self, state: State) -> State:
        """Return the state with the end where the angle says."""
        x, y = stick_end(self.theta, state[Spaces].length)
        return setting(state, Spaces, {"x": x, "y": y})


@dataclass(frozen=True)
class Represent(Command):
    """Represent the stick by other numbers; by theta its end is where it can be."""

    by: str
    label: ClassVar[str] = "representation of the stick"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        state = setting(state, Spaces, {"by": self.by})
        part = state[Spaces]
        return state if part.by == "xy" else MoveEnd(part.x, part.y).apply(state)


@dataclass(frozen=True)
class SetLength(Command):
    """Give the stick another length; its end moves along with it where theta represents it."""

    length: float
    label: ClassVar[str] = "length of the stick"

    def apply(self, state: State) -> State:
        """Return the state with the length."""
        state = setting(state, Spaces, {"length": self.length})
        part = state[Spaces]
        return state if part.by == "xy" else MoveEnd(part.x, part.y).apply(state)
