"""Examples of products in symbols, each with a sentence on what to look at; some have a wrong formula for an entry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.products.state import Products
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class ProductExample:
    """A product, an entry, and perhaps a formula for it.

    Attributes
    ----------
    key, title, axes : str
    degrees : (float, float, float)
    row, column : int
        Of the selected entry, from 1.
    typed : str
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    axes: str
    degrees: tuple[float, float, float]
    row: int
    column: int
    typed: str
    says: str

    @property
    def part(self) -> Products:
        """The product as a part of the state."""
        one, two, three = (math.radians(angle) for angle in self.degrees)
        return Products(self.axes, (one, two, three), self.row, self.column, self.typed)


EXAMPLES = Registry(
    "example",
    (
        ProductExample(
            "zxz",
            "Euler angles ZXZ",
            "zxz",
            (30.0, 50.0, -40.0),
            3,
            3,
            "",
            "The last column and the last row have the middle angle alone or with one other: the angles are read off "
            "there⟦ (3.83–3.93)⟧.",
        ),
        ProductExample(
            "zxz_21",
            "Entry (2,1) of ZXZ, wrong",
            "zxz",
            (17.2, 45.8, -28.6),
            2,
            1,
            "sin(α) sin(γ) + cos(α) cos(β) sin(γ)",
            "The formula in the field differs from the entry in one function⟦: it is the one that 3.82 prints⟧.",
        ),
        ProductExample(
            "rpy",
            "Roll, pitch, yaw: ZYX",
            "zyx",
            (-28.6, 45.8, 17.2),
            3,
            1,
            "",
            "Pitch is read off entry (3,1), roll from the rest of the last row, yaw from the rest of the first "
            "column⟦ (3.104–3.108)⟧.",
        ),
        ProductExample(
            "rpy_12",
            "Entry (1,2) of ZYX, wrong",
            "zyx",
            (-28.6, 45.8, 17.2),
            1,
            2,
            "cos(α) sin(γ) - sin(α) cos(γ)",
            "A factor is missing in the formula in the field⟦: it is the one that 3.103 prints⟧.",
        ),
        ProductExample(
            "rpy_23",
            "Entry (2,3) of ZYX, wrong",
            "zyx",
            (-28.6, 45.8, 17.2),
            2,
            3,
            "sin(α) sin(β) cos(α) - cos(α) sin(γ)",
            "One angle in the formula in the field is wrong⟦: it is the one that 3.103 prints⟧.",
        ),
        ProductExample(
            "two",
            "Two axes: pan and tilt",
            "zy",
            (30.0, 20.0, 0.0),
            1,
            1,
            "",
            "The first column is the direction of a camera that pans by α and tilts by β.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseProductExample(Command):
    """Put the product of an example in place."""

    key: str
    label: ClassVar[str] = "example of a product"

    def apply(self, state: State) -> State:
        """Return the state with the product of the example."""
        return put(state, EXAMPLES[self.key].part)


def example_of(state: State) -> str:
    """Return the key of the example that is in place; empty if there is none."""
    return next((key for key, example in EXAMPLES.items() if example.part == state[Products]), "")


BENCH = Bench("products", 15, EXAMPLES, ChooseProductExample)
