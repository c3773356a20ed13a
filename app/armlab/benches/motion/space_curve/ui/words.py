"""Small pieces of markup for the page of geometry: vectors, units, remarks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.ui.format import number, scientific
from armlab.ui.html import Markup, classes, tag
from armlab.ui.markup import SIGNS
from armlab.ui.tables import head_line
from armlab.ui.units import Units

Row = tuple[str, str, Sequence[str]]
"""A row of the table of vectors: name, unit, and the cells x, y, z and the norm."""

LARGE = 1e5
"""Number on screen from which on a length is written with a power of ten: four of them must fit beside each other."""


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


def vectors(rows: Sequence[Row]) -> Markup:
    """Return vectors as a table; zeros are grey."""
    return tag("table.sc-table", head_line("", "x", "y", "z", "|·|"), [_row(*row) for row in rows])


def _row(name: str, unit: str, texts: Sequence[str]) -> Markup:
    head = tag("th", name, (" ", tag("small", unit)) if unit else None)
    return tag("tr", head, [tag(classes("td", zero=not text.strip("0.")), text) for text in texts])


def said(kind: str, text: str) -> Markup:
    """Return a sentence with the sign and the colour of a verdict."""
    return tag(f"p.{kind}", f"{SIGNS[kind]} {text}")


def corrected(text: str) -> Markup:
    """Return a line about a difference from the notes."""
    return tag("p.dim.sc-note", text)


def per_metre(value: float) -> str:
    """Return a curvature or a torsion with its unit."""
    return f"{number(value, 4)} 1/m"
