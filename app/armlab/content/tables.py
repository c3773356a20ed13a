"""Denavit-Hartenberg tables as text, pasted from books, spreadsheets, papers and programs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

from armlab.content.table_cells import plain
from armlab.content.table_grid import Grid, read_grid
from armlab.content.table_header import DH, SHOWN, Column, convention_of, in_order_of_craig, is_khalil, read_header
from armlab.content.table_values import PastedCells
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS
from armlab.kin.dh import CONVENTIONS, Convention, Row
from armlab.registry import known_name

MOST_COLUMNS = 60
"""Largest number of cells in a line; a table with limits of each joint has a dozen."""

MOST_TITLES = 4
"""Number of lines in which the header is looked for: some tables begin with a name and a number."""

BOOKS = {"standard": ("Siciliano", "Craig's"), "modified": ("Craig", "Siciliano's")}
"""Books by convention: one that uses it, and the owner of the other."""

_FIXED = re.compile(r"flange|tool|tcp|hand|gripper|ee|end[ -]?effector|base|world")


@dataclass(frozen=True)
class PastedTable:
    """The result of reading a text.

    Attributes
    ----------
    rows : tuple of Row
        Metres and radians.
    convention : "standard" or "modified"
    notes : tuple of str
        Everything that was not written but concluded, one sentence each, for the reader to confirm.
    """

    rows: tuple[Row, ...]
    convention: Convention
    notes: tuple[str, ...]


def parse_table(text: str, default_convention: str = "standard", order: Sequence[str] = DH) -> PastedTable:
    """Read a table pasted as CSV, with tabs or semicolons, in Markdown, in LaTeX, drawn, or as ``print(arm)``.

    Parameters
    ----------
    text : str
        The first table in it counts.
    default_convention : "standard" or "modified"
        Used where neither a title nor headers such as a(i-1) nor the name of a book say which.
    order : sequence of str
        The columns a, alpha, d, theta in the order of a table without a header; a joint number or R/P may precede.

    Returns
    -------
    PastedTable
        A cell such as ``q1``, ``theta1*`` or ``q2 + 90°`` marks the joint variable: revolute in the column theta,
        prismatic in d. Its number is the offset. Limits, base and tool are not read.

    Raises
    ------
    InputError
        The text names row and column, what was expected and what came.

    Examples
    --------
    >>> parse_table("a, alpha, d, theta\\n0.5, 90, 0, q1").rows[0].a
    0.5
    """
    known_name("convention", default_convention, CONVENTIONS)
    if sorted(order) != sorted(DH):
        raise InputError(f"order: expected the columns {SHOWN}, each once, got {', '.join(order)}")
    grid = read_grid(text)
    if not grid.lines:
        raise InputError("the table: expected one row for each joint, got none")
    widest = max(map(len, grid.lines))
    if widest > MOST_COLUMNS:
        raise InputError(f"the table: expected at most {MOST_COLUMNS} columns, got {widest}")
    notes = [f"Not read: {grid.left_out}."] if grid.left_out else []
    at, columns = next(
        ((i, found) for i, line in enumerate(grid.lines[:MOST_TITLES]) if (found := read_header(line))), (0, None)
    )
    lines = _joints(grid.lines[at + 1 :], columns, notes) if columns else grid.lines
    if not 1 <= len(lines) <= MAX_JOINTS:
        raise InputError(f"the table: expected 1 to {MAX_JOINTS} rows, one for each joint, got {len(lines)}")
    convention = _convention(columns or (), grid, default_convention, notes)
    if columns is None:
        columns = _columns_without_header(grid.lines, order)
        notes.append(f"There is no header; the columns are taken as {', '.join(order)}.")
    ignored = [plain(column.written) for column in columns if column.role in ("limits", "")]
    if ignored:
        notes.append(f"Not read: the columns {', '.join(ignored)}.")
    table = PastedCells(lines, columns, grid.decimal_comma)
    kinds = table.kinds(notes)
    angles, lengths = table.in_radians(kinds, notes), table.in_metres(kinds, notes)
    rows = tuple(
        Row(kind, lengths["a"][i], angles["alpha"][i], lengths["d"][i], angles["theta"][i])
        for i, kind in enumerate(kinds)
    )
    return PastedTable(rows, convention, tuple(notes))


def _joints(lines: Sequence[tuple[str, ...]], columns: Sequence[Column], notes: list[str]) -> Sequence[tuple[str, ...]]:
    """Return the rows of joints; rows of a flange or a tool at the end of some tables are left out."""
    places = [i for i, column in enumerate(columns) if column.role == "joint"]
    fixed = [line for line in lines if any(i < len(line) and _FIXED.fullmatch(plain(line[i]).lower()) for i in places)]
    if fixed:
        notes.append(f"Not read, because it is not a joint: {'; '.join(' '.join(line) for line in fixed)}.")
    return [line for line in lines if line not in fixed]


def _convention(columns: Sequence[Column], grid: Grid, default: str, notes: list[str]) -> Convention:
    """Return the convention, with a note unless the text states it: title, then header, books and the default."""
    by_header, r = convention_of(columns), next((column.role for column in columns if column.name == "r"), "")
    if is_khalil(columns):
        notes.append("Columns d and r as in Khalil's book: d is read as a(i-1), r as d.")
    elif r and any(column.name == "d" for column in columns):
        notes.append("The column r is read as a, the length along x.")
    if grid.said and by_header and grid.said != by_header:
        raise InputError(f"the table: its title says {grid.said}, but its headers are of the {by_header} convention")
    found = grid.said or by_header or grid.named or default
    if not grid.said:
        notes.append(_concluded(found, columns, by_header, grid.named))
    return cast(Convention, found)


def _concluded(convention: str, columns: Sequence[Column], by_header: str, named: str) -> str:
    """Return a sentence why a table is read in a convention that its title does not state."""
    if is_khalil(columns):
        return "Khalil's tables are of the modified convention."
    if by_header:
        index = "(i-1)" if by_header == "modified" else "(i)"
        also = f", though the text names a book with the {named} one" if named not in ("", by_header) else ""
        return f"The headers a{index} or alpha{index} mean the {by_header} convention ({BOOKS[by_header][0]}){also}."
    if named:
        return f"Read as {convention}, because the text names a book with this convention."
    own, other = BOOKS[convention]
    if convention == "standard" and in_order_of_craig(columns):
        return "Read as standard (Siciliano), but the columns stand in Craig's order: switch if it is Craig's."
    return f"Read as {convention} ({own}): switch if your book is {other}."


def _columns_without_header(lines: Sequence[Sequence[str]], order: Sequence[str]) -> tuple[Column, ...]:
    """Return the columns of a table without header: the four in order, perhaps after joint number and type."""
    width = len(lines[0])
    if not any(re.search(r"\d", cell) for cell in lines[0][1:]):
        raise InputError(
            f"the header: expected names of {SHOWN} (or α, θ, a_i, alpha_i-1, ...), got {', '.join(lines[0])}"
        )
    if width not in (len(DH), len(DH) + 1, len(DH) + 2):
        raise InputError(
            f"row 1: expected {', '.join(order)}, perhaps after a joint number or R/P, got {width} cells: "
            f"{', '.join(lines[0])}; a header with {SHOWN} allows any columns"
        )
    before = tuple(Column("joint", "", "", "joint") for _ in range(width - len(DH)))
    return before + tuple(Column(role, "", "", role) for role in order)
