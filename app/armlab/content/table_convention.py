"""The convention of a pasted table: what its title, its headers and books say, and what its numbers suggest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import cast

from armlab.content.table_grid import Grid
from armlab.content.table_header import Column, convention_of, in_order_of_craig, is_khalil
from armlab.errors import InputError
from armlab.kin.dh import Convention, Row

BOOKS = {"standard": ("Siciliano", "Craig's"), "modified": ("Craig", "Siciliano's")}
"""Books by convention: one that uses it, and the owner of the other."""

OTHER_WAY = "choose the other convention where it is read"
"""Hint for whoever has meant the other one."""

SAME = 1e-9
"""Length, metres, and sine, below which two axes count as one."""


def convention_said(columns: Sequence[Column], grid: Grid) -> str:
    """Return the convention that the text tells: by its title, then by its headers and books; empty for none.

    Raises
    ------
    InputError
        Title and headers differ.
    """
    by_header = convention_of(columns)
    if grid.said and by_header and grid.said != by_header:
        raise InputError(f"the table: its title says {grid.said}, but its headers are of the {by_header} convention")
    return grid.said or by_header or grid.named


def concluded(
    columns: Sequence[Column], grid: Grid, meant: str, rows: Sequence[Row], marked: bool
) -> tuple[Convention, tuple[str, ...]]:
    """Return the convention, with a note unless a title states it.

    Where neither the text nor ``meant`` tells one it is the standard one, or the modified one if with the standard one
    two joints in a row would do the same: hardly an arm is built like that, and in Craig's tables the first row has
    a = 0 and alpha = 0.

    Parameters
    ----------
    rows : sequence of Row
        Those of the joints.
    marked : bool
        Whether the text tells which of them turn and which slide.
    """
    notes = []
    if is_khalil(columns):
        notes.append("Columns d and r as in Khalil's book: d is read as a(i-1), r as d.")
    elif any(column.role == "a" and column.name == "r" for column in columns):
        notes.append("The column r is read as a, the length along x.")
    said = convention_said(columns, grid) or meant
    twins = _twins(rows, "standard") if marked and not said else ""
    instead = bool(twins) and not _twins(rows, "modified")
    found = said or ("modified" if instead else "standard")
    if not grid.said:
        notes.append(_instead(twins) if instead else _why(found, columns, grid.named, rows))
    return cast(Convention, found), tuple(notes)


def _why(convention: str, columns: Sequence[Column], named: str, rows: Sequence[Row]) -> str:
    """Return a sentence why a table is read in a convention that its title does not state."""
    if is_khalil(columns):
        return "Khalil's tables are of the modified convention."
    by_header = convention_of(columns)
    if by_header:
        index = "(i-1)" if by_header == "modified" else "(i)"
        also = f", though the text names a book with the {named} one" if named not in ("", by_header) else ""
        return f"The headers a{index} or alpha{index} mean the {by_header} convention ({BOOKS[by_header][0]}){also}."
    if named:
        return f"Read as {convention}, because the text names a book with this convention."
    own, other = BOOKS[convention]
    if convention == "standard" and in_order_of_craig(columns):
        return f"Read as standard (Siciliano), but the columns stand in Craig's order: if it is Craig's, {OTHER_WAY}."
    if convention == "standard" and _same_line(rows[0]) and not _same_line(rows[-1]):
        return (
            "Read as standard (Siciliano), but a and alpha of the first row are 0, as in Craig's: "
            f"if it is his, {OTHER_WAY}."
        )
    return f"Read as {convention} ({own}): if your book is {other}, {OTHER_WAY}."


def _instead(twins: str) -> str:
    own, other = BOOKS["modified"]
    return f"Read as modified ({own}), because as standard {twins}: if your book is {other}, {OTHER_WAY}."


def _twins(rows: Sequence[Row], convention: str) -> str:
    """Return in words the first two joints in a row that would do the same, or nothing.

    Two turn about one line, or two slide along parallel lines: between their axes stands alpha and a of the first row
    of the two (standard), or of the second (modified).
    """
    for i, (first, second) in enumerate(pairwise(rows), start=1):
        between = first if convention == "standard" else second
        if first.kind != second.kind:
            continue
        if not first.revolute and _same_line(replace(between, a=0.0)):
            return f"joints {i} and {i + 1} would slide in the same direction"
        if first.revolute and _same_line(between):
            return f"joints {i} and {i + 1} would turn about the same line"
    return ""


def _same_line(row: Row) -> bool:
    """Return whether a row leaves the z axis on its line."""
    return abs(row.a) <= SAME and abs(math.sin(row.alpha)) <= SAME
