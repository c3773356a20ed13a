"""Units and names on screen. Nothing is computed differently."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import UnknownName
from armlab.session.state import Command, Json, Part, PartType, State

OPTIONS: dict[str, tuple[str, ...]] = {
    "angle": ("deg", "rad"),
    "length": ("mm", "m"),
    "variable": ("q", "theta"),
    "book": ("notes", "craig", "siciliano", "corke"),
}
"""What can be chosen; the first of each is what a student sees first."""


@dataclass(frozen=True)
class Notation(Part):
    """How things are labelled.

    Attributes
    ----------
    angle : "deg" or "rad"
    length : "mm" or "m"
    variable : "q" or "theta"
        One name for all joint variables, or theta and d as in the table.
    book : str
        Whose names and column order the table has.
    """

    key: ClassVar[str] = "notation"
    kept_by_undo: ClassVar[bool] = True

    angle: str = "deg"
    length: str = "mm"
    variable: str = "q"
    book: str = "notes"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the notation of the notes, in degrees and millimetres."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything."""
        return self

    def to_json(self) -> Json:
        """Write the choices."""
        return asdict(self)

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the choices there are."""
        return cls(**{name: data[name] for name, options in OPTIONS.items() if data.get(name) in options})


PART = PartType(Notation, order=35)


@dataclass(frozen=True)
class Label(Command):
    """Choose one unit or name."""

    name: str
    value: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        if self.name not in OPTIONS:
            raise UnknownName("notation", self.name, OPTIONS)
        if self.value not in OPTIONS[self.name]:
            raise UnknownName(self.name, self.value, OPTIONS[self.name])
        changed = replace(state[Notation], **{self.name: self.value})
        return state if changed == state[Notation] else state.replace(changed)
