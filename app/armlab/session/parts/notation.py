"""Units and names on screen. Nothing is computed differently."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.session.fields import FieldPart, choice
from armlab.session.state import Json, PartType

OPTIONS: dict[str, tuple[str, ...]] = {
    "angle": ("deg", "rad"),
    "length": ("mm", "m"),
    "variable": ("q", "theta"),
    "book": ("notes", "craig", "siciliano", "corke"),
}
"""What can be chosen; the first of each is what a student sees first."""


@dataclass(frozen=True)
class Notation(FieldPart):
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

    angle: str = choice("angles", "deg", OPTIONS["angle"])
    length: str = choice("lengths", "mm", OPTIONS["length"])
    variable: str = choice("joint variables", "q", OPTIONS["variable"])
    book: str = choice("book", "notes", OPTIONS["book"])

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the choices there are: no work is lost for one that is not."""
        if isinstance(data, dict):
            data = {name: data[name] for name, options in OPTIONS.items() if data.get(name) in options}
        return super().from_json(data, robot)


PART = PartType(Notation, order=35)
