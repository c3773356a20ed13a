"""Newton's method for one equation in one unknown: the equation and where it starts."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from armlab.benches.iterate.runs.one_equation import Solved, example_named, solved, typed_function
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.ik.iterate import EXAMPLES
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, PartType, State

CLIP_KEY = "newton_1d"

FARTHEST = 1e6
"""Of a start: beyond it nothing could be drawn."""


@dataclass(frozen=True)
class Newton1D(Part):
    """One equation f(x) = 0.

    Attributes
    ----------
    example : str
        Key of an example of `armlab.kin.ik.iterate`.
    text : str
        A function of x a person has typed, which takes the place of the example; empty for none.
    x0 : float
    """

    key: ClassVar[str] = "newton_1d"

    example: str = EXAMPLES[0].key
    text: str = ""
    x0: float = EXAMPLES[0].x0

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first example."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    def to_json(self) -> Json:
        """Write equation and start."""
        return {"example": self.example, "text": self.text, "x0": self.x0}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back; raises when nothing can be computed with them."""
        opened = cls()
        part = cls(
            str(data.get("example", opened.example)), str(data.get("text", "")), float(data.get("x0", opened.x0))
        )
        check(part.example, part.text, part.x0)
        return part


PART = PartType(Newton1D, order=98)


def solution(state: State) -> Solved:
    """Return the iteration."""
    part = state[Newton1D]
    return solved(part.example, part.text, part.x0)


@dataclass(frozen=True)
class ChooseEquation(Command):
    """Take an example, with its start."""

    key: str
    label: ClassVar[str] = "equation"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        return _with(state, Newton1D(self.key, "", example_named(self.key).x0))


@dataclass(frozen=True)
class TypeEquation(Command):
    """Take a function of x as a person types it; the start stays."""

    text: str
    label: ClassVar[str] = "equation"

    def apply(self, state: State) -> State:
        """Return the state with the function."""
        text = self.text.strip()
        typed_function(text)
        return _with(state, replace(state[Newton1D], text=text))


@dataclass(frozen=True)
class StartAt(Command):
    """Start at another x."""

    x0: float
    label: ClassVar[str] = "start of Newton's method"

    def apply(self, state: State) -> State:
        """Return the state with the start."""
        return _with(state, replace(state[Newton1D], x0=self.x0))


def _with(state: State, part: Newton1D) -> State:
    """Return the state with the equation, and the film, if it is on, at its beginning."""
    check(part.example, part.text, part.x0)
    if part == state[Newton1D]:
        return state
    timeline = state[Timeline]
    rewound = replace(timeline, time=0.0, playing=False) if timeline.clip == CLIP_KEY else timeline
    return state.replace(part, rewound)


def check(key: str, text: str, x0: float) -> None:
    """Refuse an equation and a start nothing can be computed with."""
    if not math.isfinite(x0) or abs(x0) > FARTHEST:
        raise InputError(f"x₀: expected a number from −10⁶ to 10⁶, got {x0:g}")
    example_named(key)
    solved(key, text, x0)
