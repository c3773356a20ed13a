"""The table as fields: each cell is typed, the joint type is a toggle, a chosen row has tools and limits."""

from __future__ import annotations

from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.dh import Row
from armlab.session.edits import AddJoint, RemoveJoint, ReorderJoint, SetCell, SetKind, SetLimits
from armlab.session.state import Command
from armlab.ui import markup
from armlab.ui.colours import css, joint_colour
from armlab.ui.fields import Fields
from armlab.ui.format import MINUS, dot
from armlab.ui.tables import cell_text, is_variable, without_symbol
from armlab.ui.units import NAMES, Units

_PAGE = "dh"
"""Before the names of all cells, since a page has fields of other panels, too."""


class DhEditor:
    """The table of one panel.

    Parameters
    ----------
    fields : Fields
        What people type and press is given to `typed`.
    units : Units
    """

    def __init__(self, fields: Fields, units: Units) -> None:
        self._fields, self._units = fields, units
        self._chosen: int | None = None

    def show(self, arm: Arm) -> None:
        """Show the table and the tools of the chosen row."""
        if self._chosen is not None and self._chosen >= arm.n:
            self._chosen = None
        rows = "".join(self._row(row, i) for i, row in enumerate(arm.rows))
        table = f'<table class="dh edit"><tr>{self._heads(arm)}</tr>{rows}</table>'
        self._fields.show(table + self._tools(arm))

    def typed(self, arm: Arm, cell: str, text: str) -> Command | None:
        """Return the command that a field or a button asks for; None when it only chooses a row or changes nothing.

        Raises
        ------
        InputError
            What was typed is not a number; names row and column.
        """
        _, row, name = cell.split("-")
        i = int(row) - 1
        if i >= arm.n:  # removed in another tab
            return None
        if name in NAMES:
            return self._cell_typed(arm, i, name, text)
        if name in ("low", "high"):
            return self._limit_typed(arm, i, name, text)
        if name == "row":
            self._chosen = None if self._chosen == i else i
            return None
        if name == "kind":
            return SetKind(i, "P" if arm.rows[i].revolute else "R")
        return self._tool(arm, i, name)

    def _cell_typed(self, arm: Arm, i: int, field: str, text: str) -> Command | None:
        row = arm.rows[i]
        if text == _shown(row, field, self._units):
            return None
        if is_variable(row, field):
            text = without_symbol(text) or "0"
        where = f"row {i + 1}, {self._units.book.symbols[field]}"
        return SetCell(i, field, self._units.read(text, field in ("alpha", "theta"), where))

    def _limit_typed(self, arm: Arm, i: int, name: str, text: str) -> Command | None:
        revolute, (low, high) = arm.rows[i].revolute, arm.limits[i].tolist()
        if text == self._limit(low if name == "low" else high, revolute):
            return None
        value = self._units.read(text, revolute, f"limits of joint {i + 1}")
        return SetLimits(i, value, high) if name == "low" else SetLimits(i, low, value)

    def _tool(self, arm: Arm, i: int, name: str) -> Command:
        if name == "add":
            if self._chosen is not None:
                self._chosen = i + 1
            return AddJoint(i)
        if name == "remove":
            self._chosen = None
            return RemoveJoint(i)
        to = i - 1 if name == "up" else i + 1
        if 0 <= to < arm.n:
            self._chosen = to
        return ReorderJoint(i, to)

    # -- markup --------------------------------------------------------------------------------------------------

    def _heads(self, arm: Arm) -> str:
        heads = "".join(
            f'<th class="{field}" title="{NAMES[field]}">{self._units.column(field, arm.convention)}</th>'
            for field in self._units.book.order
        )
        return f"<th>joint</th>{heads}"

    def _row(self, row: Row, i: int) -> str:
        other = "prismatic" if row.revolute else "revolute"
        kind = "revolute" if row.revolute else "prismatic"
        channel, name = self._fields.channel_id, f"{dot(css(joint_colour(i)))}{i + 1}"
        about = f"Joint {i + 1}: click for its limits and to move or remove it"
        change = f"Joint {i + 1} is {kind}: click to make it {other}"
        head = markup.button(channel, _name(i, "row"), name, "head", about, pressed=i == self._chosen)
        head += markup.button(channel, _name(i, "kind"), row.kind, "kind", change)
        cells = "".join(self._cell(row, i, field) for field in self._units.book.order)
        mark = ' class="chosen"' if i == self._chosen else ""
        return f"<tr{mark}><td>{head}</td>{cells}</tr>"

    def _cell(self, row: Row, i: int, field: str) -> str:
        text = _shown(row, field, self._units)
        zero = ' class="zero"' if getattr(row, field) == 0.0 else ""
        label = f"row {i + 1}, {NAMES[field]}"
        if is_variable(row, field):
            inside = self._fields.field(
                _name(i, field), text, f"{label}, offset of the joint variable", below=_name(i + 1, field)
            )
            symbol = self._units.variable(i, row.revolute)
            return f'<td{zero}><div class="var" style="--w:{len(text)}ch"><i>{symbol}</i>{inside}</div></td>'
        return f"<td{zero}>{self._fields.field(_name(i, field), text, label, below=_name(i + 1, field))}</td>"

    def _tools(self, arm: Arm) -> str:
        i = self._chosen
        add = self._chip(arm.n - 1 if i is None else i, "add", "+ joint", "Add a revolute joint", arm.n == MAX_JOINTS)
        if i is None:
            return f'<div class="bar">{add}<span class="dim">Click a joint for its limits and its place.</span></div>'
        moves = (
            self._chip(i, "up", "↑", "Move the row up", i == 0)
            + self._chip(i, "down", "↓", "Move the row down", i == arm.n - 1)
            + self._chip(i, "remove", "✕", "Remove the joint", arm.n == 1)
            + add
        )
        revolute, (low, high) = arm.rows[i].revolute, arm.limits[i].tolist()
        limits = "".join(
            self._fields.field(_name(i, name), self._limit(value, revolute), f"{name} limit of joint {i + 1}")
            for name, value in (("low", low), ("high", high))
        )
        ends = markup.row(f"from, to, {self._units.unit(revolute)}", limits, wide=True, cells=True)
        return markup.row(f"joint {i + 1}", moves, wide=True) + ends

    def _limit(self, value: float, revolute: bool) -> str:
        return cell_text(value, "theta" if revolute else "d", self._units)

    def _chip(self, i: int, name: str, inside: str, title: str, off: bool) -> str:
        return markup.chip(self._fields.channel_id, _name(i, name), inside, title, off=off)


def _name(i: int, name: str) -> str:
    return f"{_PAGE}-{i + 1}-{name}"


def _shown(row: Row, field: str, units: Units) -> str:
    """Return the text of a cell; that of the variable is its offset, with a sign."""
    value: float = getattr(row, field)
    text = cell_text(value, field, units)
    return text if not is_variable(row, field) or text.startswith(MINUS) else f"+{text}"
