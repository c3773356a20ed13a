"""Units and names on screen; computations do not depend on them."""

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
    "notes": ("off", "on"),
}
"""Choices of each setting; the first one is the default."""


@dataclass(frozen=True)
class Notation(FieldPart):
    """The chosen units and names.

    Attributes
    ----------
    angle : "deg" or "rad"
    length : "mm" or "m"
    variable : "q" or "theta"
        One name for all joint variables, or theta and d as in the table.
    book : str
        Whose names and column order the table has.
    notes : "off" or "on"
        Whether errata and equation numbers of the course notes are shown.
    """

    key: ClassVar[str] = "notation"
    called: ClassVar[str] = "units and names"
    kept_by_undo: ClassVar[bool] = True

    angle: str = choice("angles", "deg", OPTIONS["angle"])
    length: str = choice("lengths", "mm", OPTIONS["length"])
    variable: str = choice("joint variables", "q", OPTIONS["variable"])
    book: str = choice("book", "notes", OPTIONS["book"])
    notes: str = choice("references to the course notes", "off", OPTIONS["notes"])

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the valid choices from JSON; invalid ones are ignored, so that no work is lost."""
        if isinstance(data, dict):
            data = {name: data[name] for name, options in OPTIONS.items() if data.get(name) in options}
        return super().from_json(data, robot)

    def to_json(self) -> Json:
        """Return the choices; the notes only where they are shown, so that older labs read what is saved here."""
        data = super().to_json()
        if isinstance(data, dict) and self.notes == OPTIONS["notes"][0]:
            del data["notes"]
        return data


PART = PartType(Notation, order=35)
