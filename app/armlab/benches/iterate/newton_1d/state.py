"""Newton's method for one equation in one unknown: the equation and the start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.iterate.runs.one_equation import Solved, example_named, solved, typed_function
from armlab.kin.ik.iterate import EXAMPLES
from armlab.session.fields import FieldPart, choice, number, put, text
from armlab.session.state import Command, PartType, State

CLIP_KEY = "newton_1d"

FARTHEST = 1e6
"""Largest absolute value of a start that can be drawn."""


@dataclass(frozen=True)
class Newton1D(FieldPart):
    """One equation f(x) = 0, which does not depend on the arm.

    Attributes
    ----------
    example : str
        Key of an example of `armlab.kin.ik.iterate`.
    text : str
        A typed function of x, which replaces the example; empty for none.
    x0 : float
    """

    key: ClassVar[str] = "newton_1d"
    clip: ClassVar[str] = CLIP_KEY

    example: str = choice("equation", EXAMPLES[0].key, {each.key: each.title for each in EXAMPLES})
    text: str = text("function of x")
    x0: float = number("x₀", "start of Newton's method", EXAMPLES[0].x0, -FARTHEST, FARTHEST)

    def check(self) -> None:
        """Refuse an equation or a start that cannot be computed with."""
        solved(self.example, self.text, self.x0)


PART = PartType(Newton1D, order=98)


def solution(state: State) -> Solved:
    """Return the iteration."""
    part = state[Newton1D]
    return solved(part.example, part.text, part.x0)


@dataclass(frozen=True)
class ChooseEquation(Command):
    """Choose an example, with its start."""

    key: str
    label: ClassVar[str] = "equation"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        return put(state, Newton1D(self.key, "", example_named(self.key).x0))


@dataclass(frozen=True)
class TypeEquation(Command):
    """Set a typed function of x; the start stays."""

    text: str
    label: ClassVar[str] = "equation"

    def apply(self, state: State) -> State:
        """Return the state with the function."""
        text = self.text.strip()
        typed_function(text)
        return put(state, state[Newton1D].with_values({"text": text}))
