"""The table as fields: each cell is typed, the joint type is a toggle, and a chosen row has tools and limits."""

from __future__ import annotations

from functools import partial

from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.dh import Row
from armlab.session.edits import AddJoint, RemoveJoint, ReorderJoint, SetCell, SetKind, SetLimits
from armlab.session.sizes import ANGLES, LONGEST, MOST_TURNED, widest
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form, Pressed, Wish
from armlab.ui.format import MINUS, dot
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import row as line
from armlab.ui.tables import cell_text, is_variable, without_symbol
from armlab.ui.units import NAMES, Units

_PAGE = "dh"
"""Prefix of the names of all cells, since a page has fields of other panels, too."""


class DhEditor:
    """The table of one panel.

    Parameters
    ----------
    form : Form
    units : Units
    """

    def __init__(self, form: Form, units: Units) -> None:
        self._form, self._units = form, units
        self._chosen: int | None = None

    def show(self, arm: Arm) -> None:
        """Show the table and the tools of the chosen row."""
        self._form.show(self.table_markup(arm))

    def table_markup(self, arm: Arm) -> Inside:
        """Return the table and the tools of the chosen row."""
        if self._chosen is not None and self._chosen >= arm.n:
            self._chosen = None
        rows = [self._row(row, i) for i, row in enumerate(arm.rows)]
        return tag("table.dh.edit", self._heads(arm), rows), self._tools(arm)

    # -- what a person does; nothing where a field is left as it was -----------------------------------------------

    def _cell_typed(self, i: int, row: Row, field: str, text: str) -> Wish:
        if text == _shown(row, field, self._units):
            return None
        if is_variable(row, field):
            text = without_symbol(text) or "0"
        where = f"row {i + 1}, {self._units.book.symbols[field]}"
        turns = field in ANGLES
        return SetCell(i, field, self._units.read(text, turns, where, within=widest(turns)))

    def _limit_typed(self, i: int, arm: Arm, name: str, text: str) -> Wish:
        revolute, (low, high) = arm.rows[i].revolute, arm.limits[i].tolist()
        if text == self._limit(low if name == "low" else high, revolute):
            return None
        most = MOST_TURNED if revolute else LONGEST
        value = self._units.read(text, revolute, f"limits of joint {i + 1}", within=(-most, most))
        return SetLimits(i, value, high) if name == "low" else SetLimits(i, low, value)

    def _choose(self, i: int) -> None:
        self._chosen = None if self._chosen == i else i

    def _add(self, i: int) -> AddJoint:
        if self._chosen is not None:
            self._chosen = i + 1
        return AddJoint(i)

    def _remove(self, i: int) -> RemoveJoint:
        self._chosen = None
        return RemoveJoint(i)

    def _move(self, i: int, to: int) -> ReorderJoint:
        self._chosen = to
        return ReorderJoint(i, to)

    # -- markup --------------------------------------------------------------------------------------------------

    def _heads(self, arm: Arm) -> Markup:
        heads = [
            tag(f"th.{field}", self._units.column(field, arm.convention), title=NAMES[field])
            for field in self._units.book.order
        ]
        return tag("tr", tag("th", "joint"), heads)

    def _row(self, row: Row, i: int) -> Markup:
        other = "prismatic" if row.revolute else "revolute"
        kind = "revolute" if row.revolute else "prismatic"
        name, to_other = (dot(css(joint_colour(i))), str(i + 1)), SetKind(i, "P" if row.revolute else "R")
        about = f"Joint {i + 1}: click for its limits and to move or remove it"
        change = f"Joint {i + 1} is {kind}: click to make it {other}"
        choose = partial(self._choose, i)
        head = tag(
            "td",
            self._form.button(_name(i, "row"), name, choose, "head", about, pressed=i == self._chosen),
            self._form.button(_name(i, "kind"), row.kind, to_other, "kind", change),
        )
        cells = [self._cell(row, i, field) for field in self._units.book.order]
        return tag(classes("tr", chosen=i == self._chosen), head, cells)

    def _cell(self, row: Row, i: int, field: str) -> Markup:
        text = _shown(row, field, self._units)
        kind = classes("td", zero=getattr(row, field) == 0.0)
        label = f"row {i + 1}, {NAMES[field]}"
        variable, typed = is_variable(row, field), partial(self._cell_typed, i, row, field)
        label += ", offset of the joint variable" if variable else ""
        inside = self._form.field(_name(i, field), text, label, typed, below=_name(i + 1, field))
        if not variable:
            return tag(kind, inside)
        symbol = tag("i", self._units.variable(i, row.revolute))
        return tag(kind, tag("div.var", symbol, inside, style=f"--w:{len(text)}ch"))

    def _tools(self, arm: Arm) -> Inside:
        i, full = self._chosen, arm.n == MAX_JOINTS
        after = arm.n - 1 if i is None else i
        add = self._chip(after, "add", "+ joint", partial(self._add, after), "Add a revolute joint", full)
        if i is None:
            return tag("div.bar", add, tag("span.dim", "Click a joint to set its limits, or to move or remove it."))
        moves = (
            self._chip(i, "up", "↑", partial(self._move, i, i - 1), "Move the row up", i == 0),
            self._chip(i, "down", "↓", partial(self._move, i, i + 1), "Move the row down", i == arm.n - 1),
            self._chip(i, "remove", "✕", partial(self._remove, i), "Remove the joint", arm.n == 1),
            add,
        )
        revolute, (low, high) = arm.rows[i].revolute, arm.limits[i].tolist()
        limits = [
            self._form.field(
                _name(i, name),
                self._limit(value, revolute),
                f"{name} limit of joint {i + 1}",
                partial(self._limit_typed, i, arm, name),
            )
            for name, value in (("low", low), ("high", high))
        ]
        ends = line(f"from, to, {self._units.unit(revolute)}", limits, wide=True, cells=True)
        return line(f"joint {i + 1}", moves, wide=True), ends

    def _limit(self, value: float, revolute: bool) -> str:
        return cell_text(value, "theta" if revolute else "d", self._units)

    def _chip(self, i: int, name: str, inside: str, action: Pressed, title: str, off: bool) -> Markup:
        return self._form.chip(_name(i, name), inside, action, title, off=off)


def _name(i: int, name: str) -> str:
    return f"{_PAGE}-{i + 1}-{name}"


def _shown(row: Row, field: str, units: Units) -> str:
    """Return the text of a cell; that of the joint variable is its offset, with a sign."""
    value: float = getattr(row, field)
    text = cell_text(value, field, units)
    return text if not is_variable(row, field) or text.startswith(MINUS) else f"+{text}"
