"""A formula that is typed for an entry of a product, compared with the entry at seeded points."""

from __future__ import annotations

import re
from functools import lru_cache

from armlab.content.identity import Comparison, compare, read_formula
from armlab.errors import InputError
from armlab.kin.rotation_products import ANGLES, product_entries

LETTERS = dict(zip("αβγ", ANGLES, strict=True)) | dict(zip("abg", ANGLES, strict=True))
"""Short names of the angles."""

_SHORT = re.compile(rf"(?<![\w])([cs])_?({'|'.join((*LETTERS, *ANGLES))})(?![\w])")
_FUNCTIONS = {"c": "cos", "s": "sin"}


def written_out(text: str) -> str:
    """Return a formula with cosines and sines in place of their short forms.

    >>> written_out("sa cg + c_alpha sβ")
    'sin(alpha) cos(gamma) + cos(alpha) sin(beta)'
    """
    return _SHORT.sub(lambda found: f"{_FUNCTIONS[found[1]]}({LETTERS.get(found[2], found[2])})", text)


@lru_cache(maxsize=64)
def compared(axes: str, row: int, column: int, text: str) -> Comparison:
    """Return how a typed formula compares with an entry, row and column from 1.

    Raises
    ------
    InputError
        It cannot be read, or has other variables than the angles of the product.
    """
    if len(text) > 0 and not text.strip():
        raise InputError("formula: expected a formula, got blanks")
    try:
        formula = read_formula(written_out(text))
    except InputError as error:
        raise InputError(f"formula: {error}") from None
    angles = ANGLES[: len(axes)]
    others = sorted(formula.names - {*angles, "e", "i"})
    if others:
        raise InputError(f"formula: expected {', '.join(angles)} and no other variables, got {', '.join(others)}")
    try:
        return compare(formula, read_formula(product_entries(axes, "text")[row - 1][column - 1]), {})
    except InputError as error:
        raise InputError(f"formula: {error}") from None
