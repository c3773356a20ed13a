"""The first visit: a card that says where to start, and a tour of a few stops."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.state import Command, Json, Part, PartType, State
from armlab.teaching.parts.lesson import LessonPart

STOPS = 4
"""Number of stops of the tour."""

LEFT, CARD, TOUR = "left", "card", "tour"


@dataclass(frozen=True)
class Welcome(Part):
    """Where the student is on the first visit.

    Somebody whose work was saved, or who has come to a lesson or a shared arm, has left it, and so has somebody who
    closed it once: Help shows it again to those who ask for it.

    Attributes
    ----------
    at : "left", "card" or "tour"
    stop : int
        The stop of the tour, from 0.
    """

    key: ClassVar[str] = "welcome"
    kept_by_undo: ClassVar[bool] = True

    at: str = LEFT
    stop: int = 0

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part of somebody who has left it; a new student begins with the card."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def begun(self, token: str) -> Self:
        """Return the part with the card of the first visit."""
        return type(self)(CARD)

    def after(self, before: State, now: State) -> Self:
        """Return the part left when a lesson is opened."""
        begun = now[LessonPart].open != before[LessonPart].open and bool(now[LessonPart].open)
        return type(self)() if begun and self.at == CARD else self

    def to_json(self) -> Json:
        """Return that it has been left: who comes back has been here."""
        return LEFT

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part of somebody who comes back."""
        return cls()


PART = PartType(Welcome, order=98)


@dataclass(frozen=True)
class ShowCard(Command):
    """Show the card that says where to start."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the card."""
        return state.replace(Welcome(CARD))


@dataclass(frozen=True)
class TakeTour(Command):
    """Go to a stop of the tour, from 0."""

    stop: int = 0
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at the stop."""
        if not 0 <= self.stop < STOPS:
            raise InputError(f"stop: expected 1 to {STOPS}, got {self.stop + 1}")
        return state.replace(Welcome(TOUR, self.stop))


@dataclass(frozen=True)
class LeaveWelcome(Command):
    """Leave the card or the tour."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without them."""
        return state if state[Welcome].at == LEFT else state.replace(Welcome())
