"""Numbers, symbols and units of the page of curves."""

from __future__ import annotations

import math

from armlab.ui.colours import JOINTS, Rgb
from armlab.ui.format import MINUS, number, scientific
from armlab.ui.units import plain_number

COLOURS: tuple[Rgb, ...] = JOINTS[:3]
"""Colours of the curves."""

SYMBOLS = ("q", "q̇", "q̈", "q⃛")
_POWERS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def figures(value: float, digits: int = 4) -> str:
    """Return a number with ``digits`` significant digits, or with a power of ten if it is very large or small.

    >>> figures(2.4), figures(-0.16667, 3), figures(1234.56), figures(4e-7)
    ('2.4', '−0.167', '1235', '4.0·10⁻⁷')
    """
    if value == 0.0:
        return "0"
    if not 1e-4 <= abs(value) < 1e6:
        return scientific(value)
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    text = number(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text


def typed_number(value: float) -> str:
    """Return a number for a field; the stored one keeps all its digits until it is typed again."""
    return f"{value + 0.0:.7g}".replace("-", MINUS)


def read_rows(text: str) -> tuple[tuple[float, ...], ...]:
    """Return the typed knots, ``t q`` in each line or between semicolons; `InputError` names the knot."""
    rows = [row for row in text.replace(";", "\n").splitlines() if row.strip()]
    return tuple(
        tuple(plain_number(cell, f"knot {k}") for cell in row.replace(", ", " ").replace("\t", " ").split())
        for k, row in enumerate(rows, start=1)
    )


def unit(order: int, of: str) -> str:
    """Return the unit of a derivative with respect to time.

    >>> unit(0, "rad"), unit(1, "rad"), unit(3, "mm")
    ('rad', 'rad/s', 'mm/s³')
    """
    return of if order == 0 else f"{of}/s{'' if order == 1 else str(order).translate(_POWERS)}"


def power(letter: str, exponent: int) -> str:
    """Return a power of a letter.

    >>> power("τ", 3), power("t", 1), power("t", 0)
    ('τ³', 't', '1')
    """
    return "1" if exponent == 0 else letter if exponent == 1 else f"{letter}{str(exponent).translate(_POWERS)}"


def polynomial(coefficients: tuple[float, ...], letter: str) -> str:
    """Return a polynomial with the highest power first, without zero terms.

    >>> polynomial((6, -15, 10, 0, 0, 0), "τ")
    '6τ⁵ − 15τ⁴ + 10τ³'
    """
    degree = len(coefficients) - 1
    said = ""
    for k, value in enumerate(coefficients):
        if value == 0.0:
            continue
        sign = (f" {MINUS} " if value < 0.0 else " + ") if said else (MINUS if value < 0.0 else "")
        size, where = figures(abs(value)), power(letter, degree - k)
        said += sign + (size if where == "1" else where if size == "1" else f"{size}{where}")
    return said or "0"
