"""Examples of two time laws of omega, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.integral.state import FIRST, QUARTER, Integral, Law, Piece
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class IntegralExample:
    """Two time laws.

    Attributes
    ----------
    key, title : str
    laws : (Law, Law)
    about : "base" or "body"
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    laws: tuple[Law, Law]
    about: str
    says: str


def _pieces(rate: float, *axes: tuple[float, float, float]) -> Law:
    return tuple(Piece(*axis, rate, 1.0) for axis in axes)


X, Y, MINUS_X, MINUS_Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)

TENTH = math.radians(9.0)

EXAMPLES = Registry(
    "example",
    (
        IntegralExample(
            "notes",
            "z, then x, and x, then z⟦ (5.19)⟧",
            FIRST,
            "base",
            "Both integrals of ω are (90°, 0°, 90°), and the bodies end 120° apart: the integral is no orientation.",
        ),
        IntegralExample(
            "closed",
            "An integral of zero",
            (_pieces(QUARTER, X, Y, MINUS_X, MINUS_Y), _pieces(QUARTER, X, MINUS_X)),
            "body",
            "Each axis is turned about once forwards and once backwards, so both integrals are zero. The first body "
            "does not come back, the second one does.",
        ),
        IntegralExample(
            "small",
            "An integral of zero, ten times smaller",
            (_pieces(TENTH, X, Y, MINUS_X, MINUS_Y), _pieces(TENTH, X, MINUS_X)),
            "body",
            "Steps of 9° in place of 90° leave 1.4° about z: the square of a step in radians. A gyroscope that shakes "
            "so drifts, although its readings have the mean zero.",
        ),
        IntegralExample(
            "one_axis",
            "One axis, another course",
            (
                (Piece(1.0, 2.0, 2.0, QUARTER, 2.0),),
                (Piece(1.0, 2.0, 2.0, 3.0 * QUARTER, 1.0), Piece(1.0, 2.0, 2.0, -QUARTER, 1.0)),
            ),
            "base",
            "As long as the axis stays, the integral of ω is the angle about it, and equal integrals end alike.",
        ),
        IntegralExample(
            "both_at_once",
            "One after the other, and both at once",
            (FIRST[0], (Piece(1.0, 0.0, 1.0, math.sqrt(2.0) * QUARTER, 1.0), Piece(0.0, 0.0, 1.0, 0.0, 1.0))),
            "base",
            "The same integral about one axis between x and z: a third orientation, by a rotation of 127.3°.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseIntegralExample(Command):
    """Put the two time laws of an example in place."""

    key: str
    label: ClassVar[str] = "example of two time laws of ω"

    def apply(self, state: State) -> State:
        """Return the state with the laws of the example."""
        example = EXAMPLES[self.key]
        return put(state, Integral(example.laws, example.about))


def example_of(state: State) -> str:
    """Return the key of the example that is in place; empty if there is none."""
    part = state[Integral]
    return next((key for key, each in EXAMPLES.items() if (each.laws, each.about) == (part.laws, part.about)), "")


BENCH = Bench("integral", 17, EXAMPLES, ChooseIntegralExample)
