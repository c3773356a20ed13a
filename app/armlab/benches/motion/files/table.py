"""Samples of a motion from a table of text, written by the lab, a spreadsheet or another tool."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.files.columns import Column, columns_of, headless, rate_columns
from armlab.benches.motion.plan.question import Recorded
from armlab.benches.motion.plan.state import checked_recorded
from armlab.errors import InputError
from armlab.kin.arm import Arm

Floats = NDArray[np.float64]

MOST_BYTES = 1_500_000
"""Largest number of bytes of a file, which is also the most that the page can send in one message."""

MOST_COLUMNS = 1000
"""Largest number of columns of a table; other programs write many that are not read."""

MOST_ROWS = 6000
"""Largest number of rows: half a minute at 200 samples a second. The spline through them is planned again for every
limit."""

SHOWN = 30
"""Largest number of characters that are shown of a cell that cannot be read."""


@dataclass(frozen=True)
class Row:
    """A line of a table: its number in a spreadsheet, and its cells."""

    number: int
    cells: list[str]


def read_table(arm: Arm, text: str) -> Recorded:
    """Return the motion of a table.

    A column for the time and one for each joint are read, by their names (see `columns_of`), others are passed over;
    without a header they are time and joints in this order. Cells are apart by tabs, semicolons, commas or spaces;
    decimal commas are read where commas do not keep cells apart.

    Parameters
    ----------
    arm : Arm
    text : str
        At most `MOST_BYTES` and `MOST_ROWS`.

    Raises
    ------
    InputError
        It is no such table; the text names the row, as a spreadsheet counts, and the column.
    """
    refuse_unreadable(text, "table")
    lines = [(i, line) for i, line in enumerate(text.lstrip("\ufeff").splitlines(), start=1) if line.strip()]
    number, first = lines[0][0], lines[0][1].strip().lstrip("#%").strip()
    apart = _separator(first)
    _refuse_wide(first, apart)
    head = _header(first, apart, number)
    named = not all(_is_number(cell, apart) for cell in head)
    _refuse_many(len(lines) - named)
    columns = columns_of(arm, head, number) if named else headless(arm, len(head), number)
    rows = [Row(i, _cells(line, apart)) for i, line in lines[named:]]
    values = _numbers(rows, columns, len(head))
    _refuse_late(rows, columns[0], values[:, 0])
    _refuse_outside(arm, rows, columns[1:], values[:, 1:])
    rates = [rate_columns(arm, head, order) if named else None for order in (1, 2)]
    qdot, qddot = (None if of is None else _numbers(rows, of, len(head)) for of in rates)
    return checked_recorded(arm, values[:, 0], values[:, 1:], qdot, qddot)


def refuse_unreadable(text: str, what: str) -> None:
    """Raise `InputError` for content that is too long, empty, or no text."""
    # Counted in characters first: the bytes of a huge text need not be made.
    if len(text) > MOST_BYTES or len(text.encode("utf-8", "replace")) > MOST_BYTES:
        raise InputError(
            f"{what}: the file is larger than {MOST_BYTES / 1e6:g} MB; write fewer samples a second, or only the time "
            "and one column for each joint"
        )
    if not text.strip("\ufeff \t\r\n"):
        raise InputError(f"{what}: the file is empty; expected a header and rows of numbers, or a plan in JSON")
    if re.search(r"[\x00-\x08\x0e-\x1f]", text):
        raise InputError(f"{what}: row 1, column 1: expected text in UTF-8, got a binary file")


def _refuse_wide(first: str, apart: str) -> None:
    count = len(first.split()) if apart == " " else first.count(apart) + 1
    if count > MOST_COLUMNS:
        raise InputError(f"table, row 1: {count} columns are too many; at most {MOST_COLUMNS} are read")


def _refuse_many(count: int) -> None:
    if count > MOST_ROWS:
        keep = -(-count // MOST_ROWS)
        raise InputError(f"table: {count} rows are too many; at most {MOST_ROWS} are read: keep one row in {keep}")


def _separator(line: str) -> str:
    """Return the separator of the cells: the strongest one outside quotation marks."""
    bare = re.sub(r'"[^"]*"', "", line)
    return next((mark for mark in "\t;," if mark in bare), " ")


def _header(line: str, apart: str, number: int) -> list[str]:
    """Return the cells of the first line, whose quotation marks may hold a separator."""
    if apart == " ":
        return line.split()
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=apart, skipinitialspace=True))]
    except csv.Error as error:
        raise InputError(f"table: row {number}: expected the names of the columns ({error})") from None


def _cells(line: str, apart: str) -> list[str]:
    plain = line.replace('"', "").replace("−", "-")
    if apart != ",":
        plain = plain.replace(",", ".")
    return plain.split() if apart == " " else plain.split(apart)


def _is_number(cell: str, apart: str) -> bool:
    """Return whether a cell of the first line holds a number, finite or not, and so is no name."""
    try:
        float(_cells(cell, apart)[0])
    except (ValueError, IndexError):
        return False
    return True


def _numbers(rows: Sequence[Row], columns: Sequence[Column], width: int) -> Floats:
    """Return the numbers of the columns in s, rad and m, (rows, columns)."""
    values = np.empty((len(rows), len(columns)))
    for k, row in enumerate(rows):
        count = len(row.cells)
        if count != width and not (count == width + 1 and not row.cells[-1].strip()):
            comma = "; decimal commas need semicolons between the cells" if count > width else ""
            raise InputError(f"table, row {row.number}: expected {width} cells, got {count}{comma}")
        try:
            values[k] = [float(row.cells[column.index]) for column in columns]
        except ValueError:
            raise next(filter(None, (_no_number(row, column) for column in columns))) from None
    # Python also reads 1_000, which no table means.
    odd = ((row, column) for row in rows for column in columns if "_" in row.cells[column.index])
    for row, column in odd:
        raise _refusal(row, column, "a number")
    bad = np.argwhere(~np.isfinite(values))
    if len(bad):
        k, j = bad[0]
        raise _refusal(rows[k], columns[j], "a finite number")
    return np.asarray(values * [column.factor for column in columns])


def _no_number(row: Row, column: Column) -> InputError | None:
    """Return the error for a cell without a number, or None."""
    try:
        float(row.cells[column.index])
    except ValueError:
        return _refusal(row, column, "a number")
    return None


def _refusal(row: Row, column: Column, expected: str) -> InputError:
    got = row.cells[column.index].strip()
    return InputError(f"table, row {row.number}, column {column.name}: expected {expected}, got {got[:SHOWN]!r}")


def _refuse_late(rows: Sequence[Row], column: Column, t: Floats) -> None:
    late = np.flatnonzero(np.diff(t) <= 0.0)
    if len(late):
        k = int(late[0]) + 1
        raise InputError(
            f"table, row {rows[k].number}, column {column.name}: {t[k]:g} s is not later than {t[k - 1]:g} s in the "
            "row before"
        )


def _refuse_outside(arm: Arm, rows: Sequence[Row], columns: Sequence[Column], q: Floats) -> None:
    room = 1e-6 * np.where(arm.revolute, 1.0, arm.length_scale)
    low, high = arm.limits.T
    outside = np.argwhere((q < low - room) | (q > high + room))
    if not len(outside):
        return
    k, j = outside[0]
    column = columns[j]
    value, least, most = (each / column.factor for each in (q[k, j], low[j], high[j]))
    hint = "" if column.unit or not arm.revolute[j] else f"; if it is in degrees, name the column q{j + 1}_deg"
    unit = column.unit or ("rad" if arm.revolute[j] else "m")
    raise InputError(
        f"table, row {rows[k].number}, column {column.name}: {value:g} {unit} is outside the limits of joint {j + 1}, "
        f"{least:.4g} to {most:.4g} {unit}{hint}"
    )
