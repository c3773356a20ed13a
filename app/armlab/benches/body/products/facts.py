"""Facts of products in symbols that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.products.entry import compared
from armlab.benches.body.products.state import Products
from armlab.content.identity import Comparison
from armlab.kin.rotation_products import product_entries, product_values
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def matrix_of(state: State) -> np.ndarray:
    """Return the numbers of the product at the present angles, (3, 3)."""
    part = state[Products]
    return product_values(part.axes, np.array(part.angles))


def typed_of(state: State) -> Comparison | None:
    """Return how the typed formula compares with the selected entry; None if nothing was typed."""
    part = state[Products]
    return compared(part.axes, part.row, part.column, part.typed) if part.typed else None


def _largest(state: State) -> float | None:
    found = typed_of(state)
    return None if found is None or len(found.left) == 0 else float(found.difference.max())


def _right(state: State) -> bool:
    found = typed_of(state)
    return found is not None and found.agrees


def _formula(state: State) -> str:
    part = state[Products]
    return product_entries(part.axes, "text")[part.row - 1][part.column - 1]


FACTS = Facts(
    __name__,
    (Products,),
    {
        "axes": Fact("the axes of the product", lambda s: s[Products].axes, kind="text"),
        "matrix": Fact("the product at the present angles, row by row", lambda s: matrix_of(s).ravel(), "", "numbers"),
        "row": Fact("the row of the selected entry", lambda s: s[Products].row, kind="count"),
        "column": Fact("the column of the selected entry", lambda s: s[Products].column, kind="count"),
        "formula": Fact("the selected entry", _formula, kind="text"),
        "typed": Fact("the formula that was typed for it", lambda s: s[Products].typed, kind="text"),
        "typed_right": Fact("whether the typed formula is that of the entry", _right, kind="truth"),
        "typed_off": Fact("the largest difference of the typed formula from the entry", _largest),
    },
)
