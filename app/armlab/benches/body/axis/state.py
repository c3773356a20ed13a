"""The page of axis and angle: what is shown, and near which angle the formulas are compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.film import with_film_at
from armlab.session.fields import FieldPart, choice
from armlab.session.state import Command, PartType, State

CLIP_KEY = "axis"

SHOWN = {"steps": "1 Three steps", "eigen": "2 Eigenvalues", "inverse": "3 Inverse"}

NEAR = {"zero": "near 0", "pi": "near π"}


@dataclass(frozen=True)
class Axis(FieldPart):
    """Choices of the page; axis and angle are those of the body.

    Attributes
    ----------
    shown : "steps", "eigen" or "inverse"
    near : "zero" or "pi"
        Angle near which the errors of the two formulas for it are drawn.
    """

    key: ClassVar[str] = "axis"
    looks: ClassVar[tuple[str, ...]] = ("shown", "near")

    shown: str = choice("what is shown of axis and angle", "steps", SHOWN)
    near: str = choice("angle near which formulas are compared", "zero", NEAR)


PART = PartType(Axis, order=33)


@dataclass(frozen=True)
class ShowStep(Command):
    """Show the film where this many steps, 0 to 3, have been made."""

    made: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the film open there, paused."""
        return with_film_at(state, CLIP_KEY, self.made, "steps")
