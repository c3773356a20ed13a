"""The page of turns about moving and about fixed axes: in which order the second body makes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.film import time_of, with_film_at
from armlab.session.fields import FieldPart, choice
from armlab.session.state import Command, PartType, State

CLIP_KEY = "sequence"

ORDERS = {"reverse": "reverse order", "same": "same order"}


@dataclass(frozen=True)
class Sequence(FieldPart):
    """Choices of the page; the turns are those of the body.

    Attributes
    ----------
    order : "reverse" or "same"
        In which order the other body makes the turns of the sequence that was chosen.
    """

    key: ClassVar[str] = "sequence"

    order: str = choice("order of the turns of the other body", "reverse", ORDERS)


PART = PartType(Sequence, order=32)


@dataclass(frozen=True)
class ShowTurn(Command):
    """Show the film where this many turns, 0 to 3, have been made."""

    made: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the film open there, paused."""
        return with_film_at(state, CLIP_KEY, self.made, "turns")


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its end while it is closed."""
    return time_of(state, CLIP_KEY)
