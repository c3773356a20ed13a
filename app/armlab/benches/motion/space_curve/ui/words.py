"""Small pieces of markup the page of geometry is made of: vectors, units, remarks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.ui.format import escaped, number, scientific
from armlab.ui.markup import SIGNS
from armlab.ui.units import Units

Row = tuple[str, str, Sequence[str]]
"""Name, unit, and the cells: x, y, z and the norm."""

LARGE = 1e5
"""From this number on screen on a length is written with a power of ten: four of them must fit beside each other."""


def length(value: float, units: Units) -> str:
    """Return a length in metres as a text in the unit on screen, without it."""
    shown = value / units.factor(False)
    return units.text(value, False) if abs(shown) < LARGE else scientific(shown, 2)


def lengths(vector: NDArray[np.floating], units: Units) -> tuple[str, ...]:
    """Return the components of a vector in metres and its norm, as texts in the unit on screen."""
    return tuple(length(float(value), units) for value in (*vector, np.linalg.norm(vector)))


def plain(vector: NDArray[np.floating], decimals: int = 3) -> tuple[str, ...]:
    """Return the components of a vector of pure numbers and its norm, as texts."""
    return tuple(number(float(value), decimals) for value in (*vector, np.linalg.norm(vector)))


def vectors(rows: Sequence[Row]) -> str:
    """Return vectors as a table; zeros are grey."""
    heads = "".join(f"<th>{head}</th>" for head in ("", "x", "y", "z", "|·|"))
    return f'<table class="sc-table"><tr>{heads}</tr>{"".join(_row(*row) for row in rows)}</table>'


def _row(name: str, unit: str, cells: Sequence[str]) -> str:
    texts = "".join(f"<td{_grey(cell)}>{cell}</td>" for cell in cells)
    small = f" <small>{escaped(unit)}</small>" if unit else ""
    return f"<tr><th>{name}{small}</th>{texts}</tr>"


def _grey(text: str) -> str:
    return ' class="zero"' if not text.strip("0.") else ""


def said(kind: str, text: str) -> str:
    """Return a sentence with the sign and the colour of a verdict; the text is markup."""
    return f'<p class="{kind}">{SIGNS[kind]} {text}</p>'


def corrected(text: str) -> str:
    """Return a line about where the notes differ."""
    return f'<p class="dim sc-note">{text}</p>'


def per_metre(value: float) -> str:
    """Return a curvature or a torsion with its unit."""
    return f"{number(value, 4)} 1/m"
