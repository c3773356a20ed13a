"""Denavit-Hartenberg tables as text, pasted from books, spreadsheets, papers and programs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from armlab.content.table_cells import plain
from armlab.content.table_convention import concluded, convention_said
from armlab.content.table_grid import Grid, read_grid
from armlab.content.table_header import DH, SHOWN, Column, read_header
from armlab.content.table_values import FIXED, TOOL, PastedCells
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS
from armlab.kin.dh import CONVENTIONS, Convention, Kind, Row
from armlab.registry import known_name

MOST_COLUMNS = 60
"""Largest number of cells in a line; a table with limits of each joint has a dozen."""

MOST_TITLES = 4
"""Number of lines in which the header is looked for: some tables begin with a name and a number."""

Lines = Sequence[tuple[str, ...]]

_BETWEEN_NOTES = re.compile(r"(?<=\.) (?=[A-Z])")


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
    flange : tuple of Row
        Rows after those of the joints, of a flange or a tool: constants in the same convention.
    """

    rows: tuple[Row, ...]
    convention: Convention
    notes: tuple[str, ...]
    flange: tuple[Row, ...] = ()


def parse_table(text: str, default_convention: str = "", order: Sequence[str] = DH) -> PastedTable:
    """Read a table pasted as CSV, with tabs or semicolons, in Markdown, in LaTeX, drawn, or as ``print(arm)``.

    Parameters
    ----------
    text : str
        The first table in it counts.
    default_convention : "standard" or "modified", optional
        That of a table of which neither a title nor headers such as a(i-1) nor the name of a book say which. When left
        out it is the standard one, unless two joints would then do the same and would not in the modified one.
    order : sequence of str
        The columns a, alpha, d, theta in the order of a table without a header; a joint number or R/P may precede.

    Returns
    -------
    PastedTable
        A cell such as ``q1``, ``theta1*`` or ``q2 + 90°`` marks the joint variable: revolute in the column theta,
        prismatic in d. Its number is the offset. Limits and base are not read.

    Raises
    ------
    InputError
        The text names row and column, what was expected and what came.

    Examples
    --------
    >>> parse_table("a, alpha, d, theta\\n0.5, 90, 0, q1").rows[0].a
    0.5
    """
    if default_convention:
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
    lines, flange = _joints(grid, at, columns, notes) if columns else (grid.lines, ())
    n = len(lines)
    if not 1 <= n <= MAX_JOINTS:
        raise InputError(f"the table: expected 1 to {MAX_JOINTS} rows, one for each joint, got {n}")
    named, in_cells = columns or (), list[str]()
    convention_said(named, grid)  # refuses what contradicts itself before it looks at cells
    if columns is None:
        columns = _columns_without_header(grid.lines, order)
        in_cells.append(f"There is no header; the columns are taken as {', '.join(order)}.")
    ignored = [plain(column.written) for column in columns if column.role in ("limits", "")]
    if ignored:
        in_cells.append(f"Not read: the columns {', '.join(ignored)}.")
    table = PastedCells([*lines, *flange], columns, grid.decimal_comma)
    turning: Kind = "R"
    kinds = table.kinds(n, in_cells) + [turning] * len(flange)
    angles, lengths = table.in_radians(kinds, in_cells), table.in_metres(kinds, in_cells)
    rows = tuple(
        Row(kind, lengths["a"][i], angles["alpha"][i], lengths["d"][i], angles["theta"][i])
        for i, kind in enumerate(kinds)
    )
    convention, why = concluded(named, grid, default_convention, rows[:n], table.marked(n))
    return PastedTable(rows[:n], convention, (*notes, *why, *in_cells), rows[n:])


def joined_notes(notes: Sequence[str]) -> str:
    """Return notes in one line."""
    return " ".join(notes)


def single_notes(joined: str) -> list[str]:
    """Return the notes that were joined in one line; in any other text, its sentences.

    Each is shown by itself, since one that ends in cells as typed could not be told from the next.

    >>> single_notes("Not read: the columns q-, q+. Angles without a unit are taken as radians.")
    ['Not read: the columns q-, q+.', 'Angles without a unit are taken as radians.']
    """
    return _BETWEEN_NOTES.split(joined)


def _joints(grid: Grid, at: int, columns: Sequence[Column], notes: list[str]) -> tuple[Lines, Lines]:
    """Return the rows of joints, and those of a flange or a tool after them; others that are no joint are left out."""
    lines = grid.lines[at + 1 :]
    places = [i for i, column in enumerate(columns) if column.role == "joint"]

    def named(line: tuple[str, ...], names: re.Pattern[str]) -> bool:
        return any(i < len(line) and names.fullmatch(plain(line[i]).lower()) for i in places)

    def variables(line: tuple[str, ...]) -> list[str] | None:
        return _variables(line, columns, grid.decimal_comma)

    # A joint may move the base or be called the gripper: then its row has a variable.
    joints = [line for line in lines if not named(line, FIXED) or variables(line)]
    after = list(takewhile(lambda line: named(line, TOOL) and line not in joints, reversed(lines)))[::-1]
    flange = after if joints and all(variables(line) is not None for line in after) else []
    unread = [line for line in lines if line not in joints and line not in flange]
    if unread:
        notes.append(f"Not read, because it is not a joint: {'; '.join(' '.join(line) for line in unread)}.")
    if flange:
        notes.append(f"Read as the tool, because it is not a joint: {'; '.join(' '.join(line) for line in flange)}.")
    return joints, flange


def _variables(line: tuple[str, ...], columns: Sequence[Column], decimal_comma: bool) -> list[str] | None:
    """Return the joint variables in a row; None for one that cannot be read."""
    try:
        return PastedCells([line], columns, decimal_comma).variables(0)
    except InputError:
        return None


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
