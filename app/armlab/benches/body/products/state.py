"""The page of products in symbols: the axes, the angles, the selected entry, and a formula typed for it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Body, Triple
from armlab.benches.body.products.entry import compared
from armlab.kin.rotation_products import PRODUCTS
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, choice, setting, text, vector, whole
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, PartType, State

LONGEST = 300
"""Longest formula that can be typed, characters."""


@dataclass(frozen=True)
class Products(FieldPart):
    """A product of elementary rotations.

    Attributes
    ----------
    axes : str
        One of `armlab.kin.rotation_products.PRODUCTS`.
    angles : (float, float, float)
        Alpha, beta and gamma, radians; about two axes the last one is not used.
    row, column : int
        The selected entry, 1 to 3.
    typed : str
        A formula that was typed for the entry; empty for none.
    """

    key: ClassVar[str] = "products"

    axes: str = choice("axes of a product", "zxz", PRODUCTS)
    angles: Triple = vector(
        "α", "angles of a product", tuple(map(math.radians, (30.0, 50.0, -40.0))), -MOST_TURNED, MOST_TURNED, "rad"
    )
    row: int = whole("row of an entry", 2, 1, 3)
    column: int = whole("column of an entry", 1, 1, 3)
    typed: str = text("formula of an entry", "", LONGEST)

    def check(self) -> None:
        """Refuse a formula that cannot be read."""
        if self.typed:
            compared(self.axes, self.row, self.column, self.typed)


PART = PartType(Products, order=35)


@dataclass(frozen=True)
class SetProductAngle(Command):
    """Set one of the angles (rad), 0-based."""

    index: int
    value: float
    label: ClassVar[str] = "angle of a product"

    def apply(self, state: State) -> State:
        """Return the state with this angle."""
        refuse_beyond(self.index, 3, "angle")
        angles = [self.value if k == self.index else each for k, each in enumerate(state[Products].angles)]
        return Set(Products, "angles", angles).apply(state)


@dataclass(frozen=True)
class ChooseProduct(Command):
    """Choose the axes of the product; a formula that was typed for another one goes."""

    axes: str
    label: ClassVar[str] = "axes of a product"

    def apply(self, state: State) -> State:
        """Return the state with these axes."""
        typed = state[Products].typed if self.axes == state[Products].axes else ""
        return setting(state, Products, {"axes": self.axes, "typed": typed})


@dataclass(frozen=True)
class SelectEntry(Command):
    """Select an entry of the product, row and column from 1; a formula that was typed for another one goes."""

    row: int
    column: int
    label: ClassVar[str] = "entry of a product"
    places: ClassVar[Mapping[str, tuple[str, ...]]] = {"row": (), "column": ()}

    def apply(self, state: State) -> State:
        """Return the state with this entry selected."""
        part = state[Products]
        typed = part.typed if (part.row, part.column) == (self.row, self.column) else ""
        return setting(state, Products, {"row": self.row, "column": self.column, "typed": typed})


@dataclass(frozen=True)
class TypeEntry(Command):
    """Type a formula for the selected entry, to be compared with it; an empty one takes it back."""

    text: str
    label: ClassVar[str] = "formula of an entry"

    def apply(self, state: State) -> State:
        """Return the state with the formula."""
        return Set(Products, "typed", self.text.strip()).apply(state)


@dataclass(frozen=True)
class TakeBodyAngles(Command):
    """Take sequence and angles of the body; about fixed axes the product has the reverse order."""

    label: ClassVar[str] = "angles of the body"

    def apply(self, state: State) -> State:
        """Return the state with the product of the body's three turns."""
        body = state[Body]
        step = -1 if body.fixed else 1
        angles = state.derived(forms_of).triples.shown[::step].tolist()
        state = ChooseProduct(body.axes[::step]).apply(state)
        return setting(state, Products, {"angles": angles})
