"""Whether somebody has given the key of the teacher."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.session.state import Command, Part, PartType, State


@dataclass(frozen=True)
class Teacher(Part):
    """Whether the key was given. No file and no link holds it, so that none can claim it."""

    key: ClassVar[str] = "teacher"
    kept_by_undo: ClassVar[bool] = True
    saved: ClassVar[bool] = False

    let_in: bool = False

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part of somebody who has not given it."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self


PART = PartType(Teacher, order=99)


@dataclass(frozen=True)
class LetIn(Command):
    """Note that the key was given, which was looked at before; no word of lessons leads here."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state of the teacher."""
        return state.replace(Teacher(True))
