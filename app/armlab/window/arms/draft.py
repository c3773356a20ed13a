"""The table of a new arm while it is typed: texts, each row with the sentence that says what is wrong in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

from armlab.content.tables import parse_table
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS
from armlab.kin.dh import Convention, Kind, Row
from armlab.session.edits import LONGEST_NAME, NewArm
from armlab.session.parts.notation import Notation
from armlab.session.sizes import ANGLES, LENGTHS, widest
from armlab.ui.tables import is_variable, without_symbol
from armlab.ui.units import NAMES, Units

EXAMPLE = (Row("R", a=0.5), Row("R", a=0.4))
"""Rows to begin with: two links in a plane."""


@dataclass
class TypedRow:
    """A row as typed.

    Attributes
    ----------
    kind : "R" or "P"
    texts : dict of str
        By field: a, alpha, d, theta; an empty one is zero.
    wrong : str
        What is wrong in it; empty for nothing.
    where : str
        The field that is wrong.
    """

    kind: Kind = "R"
    texts: dict[str, str] = field(default_factory=lambda: dict.fromkeys((*LENGTHS, *ANGLES), ""))
    wrong: str = ""
    where: str = ""


class Draft:
    """The new arm of one page: nothing of it comes from the arm on the table.

    Parameters
    ----------
    notation : Notation
        The units that are chosen for the lab, with which it begins.

    Attributes
    ----------
    name : str
    convention : "standard" or "modified"
    units : Units
        Of the numbers as typed.
    rows : list of TypedRow
    notes : tuple of str
        What was concluded from a pasted table.
    flange : tuple of Row
        Rows after those of the joints of a pasted table, which become the tool.
    """

    def __init__(self, notation: Notation) -> None:
        self.name = ""
        self.convention: Convention = "standard"
        self.units, self.notes = Units(notation), tuple[str, ...]()
        self.rows, self.flange = self._typed(EXAMPLE), tuple[Row, ...]()

    def write(self, i: int, name: str, text: str) -> None:
        """Write a cell; what is wrong with it is kept beside the row."""
        self.rows[i].texts[name] = text
        self._read(i)

    def set_kind(self, i: int, kind: Kind) -> None:
        """Make a joint revolute or prismatic."""
        self.rows[i].kind = kind
        self._read(i)

    def set_unit(self, name: str, unit: str) -> None:
        """Say in which unit angles or lengths are typed; the rows to begin with are the same arm in any."""
        untouched = [row.texts for row in self.rows] == [row.texts for row in self._typed(EXAMPLE)]
        self.units = Units(replace(self.units.notation, **cast(Any, {name: unit})))
        if untouched:
            self.rows = self._typed(EXAMPLE)
        for i in range(len(self.rows)):
            self._read(i)

    def add(self) -> None:
        """Add a row at the end, if there is room for one."""
        if len(self.rows) < MAX_JOINTS:
            self.rows.append(TypedRow())

    def remove(self, i: int) -> None:
        """Remove a row; the last one stays."""
        if len(self.rows) > 1:
            del self.rows[i]

    def paste(self, text: str) -> None:
        """Take all rows from a text; `InputError` where it is no table."""
        found = parse_table(text)
        self.convention, self.notes = found.convention, found.notes
        self.rows, self.flange = self._typed(found.rows), found.flange

    def command(self) -> NewArm | None:
        """Return the command that puts the arm on the table; None if something is wrong, which the rows say then."""
        rows = [self._read(i) for i in range(len(self.rows))]
        whole = tuple(row for row in rows if row is not None)
        return NewArm(whole, self.convention, self.name.strip(), self.flange) if len(whole) == len(rows) else None

    def set_name(self, text: str) -> None:
        """Name the arm."""
        self.name = " ".join(text.split())[:LONGEST_NAME]

    def _typed(self, rows: Sequence[Row]) -> list[TypedRow]:
        return [TypedRow(row.kind, {name: self._text(row, name) for name in (*LENGTHS, *ANGLES)}) for row in rows]

    def _text(self, row: Row, name: str) -> str:
        value: float = getattr(row, name)
        return f"{value / self.units.factor(name in ANGLES):.12g}"

    def _read(self, i: int) -> Row | None:
        """Return a row as it is meant, or None after noting what is wrong."""
        typed = self.rows[i]
        typed.wrong = typed.where = ""
        row = Row(typed.kind)
        for name in self.units.book.order:
            text = typed.texts[name]
            text = without_symbol(text) if is_variable(row, name) else text.strip()
            try:
                turns = name in ANGLES
                value = self.units.read(text or "0", turns, NAMES[name], within=widest(turns))
            except InputError as error:
                typed.wrong, typed.where = str(error), name
                return None
            row = replace(row, **cast(Any, {name: value}))
        return row
