"""Examples of two rotations in both orders, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.state import Triple
from armlab.benches.body.order.state import Order
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State

X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class OrderExample:
    """Two rotations.

    Attributes
    ----------
    key, title : str
    a, b : (float, float, float)
        Axes.
    degrees : (float, float)
        Angles.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    a: Triple
    b: Triple
    degrees: tuple[float, float]
    says: str

    @property
    def part(self) -> Order:
        """The rotations, about axes of the base."""
        one, other = (math.radians(angle) for angle in self.degrees)
        return Order(self.a, self.b, (one, other))


EXAMPLES = Registry(
    "example",
    (
        OrderExample(
            "quarters",
            "Quarter turns about x and z⟦ (5.18)⟧",
            X,
            Z,
            (90.0, 90.0),
            "The same two quarter turns end a third of a turn apart. Displacements along x and z would end at the same "
            "place in either order⟦ (5.17)⟧.",
        ),
        OrderExample(
            "small",
            "A tenth: 9° each",
            X,
            Z,
            (9.0, 9.0),
            "The rotations are ten times smaller, the angle between the ends is nearly a hundred times smaller.",
        ),
        OrderExample(
            "tiny",
            "A hundredth of a degree each",
            X,
            Z,
            (0.01, 0.01),
            "To the eye the ends are the same. R is I + S(dφ), but for terms of the size of dφ²: infinitesimal "
            "rotations commute⟦ (5.27, which prints an equality)⟧.",
        ),
        OrderExample(
            "one_axis",
            "Both about one axis",
            (1.0, 2.0, 2.0),
            (1.0, 2.0, 2.0),
            (70.0, 110.0),
            "About one axis the angles add, in either order and however large they are.",
        ),
        OrderExample(
            "half_turns",
            "Half turns about x and z",
            X,
            Z,
            (180.0, 180.0),
            "Two half turns about perpendicular axes commute, although they are large: both orders are a half "
            "turn about y.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseOrderExample(Command):
    """Put the two rotations of an example in place."""

    key: str
    label: ClassVar[str] = "example of two rotations"

    def apply(self, state: State) -> State:
        """Return the state with the rotations of the example."""
        return put(state, EXAMPLES[self.key].part)


def example_of(state: State) -> str:
    """Return the key of the example that is in place; empty if there is none."""
    return next((key for key, example in EXAMPLES.items() if example.part == state[Order]), "")


BENCH = Bench("order", 14, EXAMPLES, ChooseOrderExample)
