"""The language in which a student reads; it belongs to the person, whatever lies on the table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.languages import keys
from armlab.content.robots import Robot
from armlab.errors import UnknownName
from armlab.session.state import Command, Json, Part, PartType, State

OF_BROWSER = "browser"
"""The choice of whoever has made none: the language that the browser asks for."""


@dataclass(frozen=True)
class LanguagePart(Part):
    """The chosen language.

    Attributes
    ----------
    chosen : str
        Key of a language, or `OF_BROWSER`.
    """

    key: ClassVar[str] = "language"
    called: ClassVar[str] = "the language"
    kept_by_undo: ClassVar[bool] = True

    chosen: str = OF_BROWSER

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part of somebody who has chosen none."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def to_json(self) -> Json:
        """Return the choice."""
        return self.chosen

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the choice from JSON; a language that is there no more is ignored, so that no work is lost."""
        return cls(data) if data in keys() else cls()

    def read_in(self, of_browser: str) -> str:
        """Return the key of the language to read in.

        Parameters
        ----------
        of_browser : str
            Key of the one that the browser asks for.
        """
        return of_browser if self.chosen == OF_BROWSER else self.chosen


PART = PartType(LanguagePart, order=36)


@dataclass(frozen=True)
class ReadIn(Command):
    """Choose a language, or `OF_BROWSER`."""

    language: str
    undoable: ClassVar[bool] = False
    label: ClassVar[str] = "language"

    def apply(self, state: State) -> State:
        """Return the state with the language chosen."""
        if self.language not in (OF_BROWSER, *keys()):
            raise UnknownName("language", self.language, (OF_BROWSER, *keys()))
        return state if state[LanguagePart].chosen == self.language else state.replace(LanguagePart(self.language))
