"""Tables that several panels use."""

from __future__ import annotations

import re

from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.ui.colours import css, joint_colour
from armlab.ui.format import dot, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import Units

_SYMBOL = re.compile(r"^\s*(?:q|theta|th|[θϑd])_?[0-9₀-₉]*\s*(?=$|[-+−])", re.IGNORECASE)


def head_line(*names: Inside) -> Markup:
    """Return the head of a table with the names of its columns."""
    return tag("tr", [tag("th", name) for name in names])


def line(*cells: Inside, name: Inside = None) -> Markup:
    """Return a line of a table, after its name if it has one."""
    return tag("tr", None if name is None else tag("th", name), [tag("td", cell) for cell in cells])


def dh_table(arm: Arm, units: Units) -> Markup:
    """Return the Denavit-Hartenberg table in the order of the book, the variable in its own cell."""
    heads = [tag("th", units.column(field, arm.convention)) for field in units.book.order]
    rows = [tag("tr", tag("th", "joint"), heads)]
    for k, row in enumerate(arm.rows):
        name = tag("td", dot(css(joint_colour(k))), subscript(row.kind, k + 1))
        rows.append(tag("tr", name, [_cell(row, k, field, units) for field in units.book.order]))
    return tag("table.dh", rows)


def is_variable(row: Row, field: str) -> bool:
    """Return whether a field of a row holds the joint variable."""
    return field == ("theta" if row.revolute else "d")


def cell_text(value: float, field: str, units: Units) -> str:
    """Return a number of the table, without zeros at its end."""
    return units.entry(value, field in ("alpha", "theta"))


def without_symbol(text: str) -> str:
    """Return the text typed into the cell of a variable without the variable: ``+ 90`` of ``q₂ + 90``."""
    return _SYMBOL.sub("", text).strip()


def _cell(row: Row, k: int, field: str, units: Units) -> Markup:
    value: float = getattr(row, field)
    if not is_variable(row, field):
        return tag("td.zero", "0") if value == 0.0 else tag("td", cell_text(value, field, units))
    q = tag("i", units.variable(k, row.revolute))
    if value == 0.0:
        return tag("td", q)
    return tag("td", q, f" {'+' if value > 0 else '−'} {cell_text(abs(value), field, units)}")
