"""The second stage of the trainer: the table, its marks, and the rule of a cell."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from armlab.benches.robot.trainer.answers import FIELDS
from armlab.benches.robot.trainer.commands import ENOUGH_MISSES, CheckTable, ReviseAxes, SetAnswer, ShowCell
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.axes import shown_direction
from armlab.benches.robot.trainer.ui.words import (
    end_line,
    indexed,
    open_line,
    parallel_line,
    reversed_line,
    rule,
    symbol,
)
from armlab.kin.assignment import CellVerdict
from armlab.session.state import Post
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form, Wish
from armlab.ui.format import dot, subscript
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import cell_text, without_symbol
from armlab.ui.units import NAMES, Units
from armlab.ui.widgets import Gui

TURNS = ("alpha", "theta")
WHICH = "Click a cell's mark, or the head of its row or column, to choose it."


class TableStage:
    """The table of the panel, and the cell that is explained.

    Parameters
    ----------
    gui : Gui
    units : Units
    trainer : Trainer
    post : callable
    """

    def __init__(self, gui: Gui, units: Units, trainer: Trainer, post: Post) -> None:
        self._units, self._trainer = units, trainer
        self._form = gui.form(post)
        # By itself, so that it is not replaced under the pointer when a field is left by pressing it.
        self._check = gui.form(post)
        self._foot = gui.form(post)
        self._row, self._field = 0, units.book.order[0]
        self._rule_seen = False
        self._checks: int | None = None
        self._frame = Markup()
        self._on_page: dict[str, str] = {}

    def show(self, trainer: Trainer) -> None:
        """Show the stage."""
        self._trainer = trainer
        if self._checks is not None and trainer.answers.table_checks > self._checks:
            self._turn_to_wrong(trainer)
        self._checks = trainer.answers.table_checks
        self._row = min(self._row, trainer.exercise.n - 1)
        self._show_table(trainer)
        hint = "Check the cells that are filled in"
        check = None if trainer.done else self._check.button("trainer-check", "Check table", CheckTable(), "main", hint)
        self._check.show(check)
        self._foot.show(self._about(trainer))

    def hide(self) -> None:
        """Hide the stage."""
        self._frame, self._on_page = Markup(), {}
        for form in (self._form, self._check, self._foot):
            form.show()

    def _show_table(self, trainer: Trainer) -> None:
        """Show the table unless the page shows it already, because the student may be typing in its next cell."""
        texts = {
            f"{i + 1}-{field}": self._text(cells[FIELDS.index(field)], field)
            for i, cells in enumerate(trainer.answers.cells)
            for field in FIELDS
        }
        frame = self._table(trainer, dict.fromkeys(texts, ""))  # with what was refused, if anything was
        if (frame, texts) != (self._frame, self._on_page):
            self._frame, self._on_page = frame, texts
            self._form.show(self._table(trainer, texts))

    # -- what a person does; the table on the page may be older than what it holds ---------------------------------

    def _ask(self, row: int | None = None, field: str = "") -> None:
        self._row, self._field = self._row if row is None else row, field or self._field

    def _turn_rule(self) -> None:
        self._rule_seen = not self._rule_seen

    def _typed(self, i: int, field: str, text: str) -> Wish:
        trainer = self._trainer
        self._on_page[f"{i + 1}-{field}"] = text
        value = trainer.answers.cells[i][FIELDS.index(field)]
        if text == self._text(value, field):
            return None
        if field == _variable(trainer, i):
            text = without_symbol(text) or ("0" if text.strip() else "")
        if not text.strip():
            return SetAnswer(i, field, None)
        return SetAnswer(
            i, field, self._units.read(text, field in TURNS, f"row {i + 1}, {symbol(self._units, field, i)}")
        )

    def _turn_to_wrong(self, trainer: Trainer) -> None:
        """Explain the first wrong cell, unless the explained one is wrong."""
        wrong = [
            (i, field)
            for i, marks in enumerate(trainer.cell_marks)
            for field in self._units.book.order
            if field in marks and not marks[field].ok
        ]
        if wrong and (self._row, self._field) not in wrong:
            self._row, self._field = wrong[0]

    # -- markup --------------------------------------------------------------------------------------------------

    def frames(self, form: Form, trainer: Trainer) -> Inside:
        """Return the frames of the table with notes on them; ``form`` gets the button."""
        assert trainer.assignment is not None
        rows = []
        for i, ((z, x), frame) in enumerate(zip(trainer.answers.axes, trainer.assignment.frames, strict=True)):
            place = [tag("td", cell_text(float(value), "d", self._units)) for value in frame[:3, 3]]
            axes = [tag(f"td.axis-{axis}", shown_direction(way)) for axis, way in (("z", z), ("x", x))]
            rows.append(tag("tr", tag("td", f"{{{i}}}"), place, axes))
        remarks = (reversed_line(trainer, self._units), parallel_line(trainer))
        back = form.button("trainer-revise", "change", ReviseAxes(), "copy", "Go back to the axes; the table is kept")
        origin = tag("th", f"origin x, y, z in {self._units.length_unit}", colspan=3)
        heads = tag("tr", tag("th", "frame"), origin, tag("th", "z"), tag("th", "x"))
        return (
            tag("h3", "Frames as you placed them", tag("span.copies", back)),
            tag("table.dh.tr-frames", heads, rows),
            [tag("p.dim", remark) for remark in remarks if remark],
        )

    def _heads(self) -> list[Markup]:
        heads = []
        for field in self._units.book.order:
            inside = self._units.column(field, "standard")
            ask = partial(self._ask, field=field)
            heads.append(tag("th", self._form.button(f"trainer-column-{field}", inside, ask, "head", NAMES[field])))
        return heads

    def _table(self, trainer: Trainer, texts: Mapping[str, str]) -> Markup:
        lines = [self._line(trainer, i, texts) for i in range(trainer.exercise.n)]
        return tag("table.dh.edit.tr-table", tag("tr", tag("th", "joint"), self._heads()), lines)

    def _line(self, trainer: Trainer, i: int, texts: Mapping[str, str]) -> Markup:
        kind = trainer.exercise.robot.arm.rows[i].kind
        name = dot(css(joint_colour(i))), subscript(kind, i + 1)
        ask = partial(self._ask, i)
        head = self._form.button(f"trainer-row-{i + 1}", name, ask, "head", f"Ask about row {i + 1}")
        cells = [self._cell(trainer, i, field, texts[f"{i + 1}-{field}"]) for field in self._units.book.order]
        return tag("tr", tag("td", head), cells)

    def _cell(self, trainer: Trainer, i: int, field: str, text: str) -> Markup:
        verdict = trainer.cell_marks[i].get(field)
        label = f"row {i + 1}, {NAMES[field]}"
        inside = self._form.field(f"trainer-cell-{i + 1}-{field}", text, label, partial(self._typed, i, field))
        variable = None
        if field == _variable(trainer, i):
            revolute = trainer.exercise.robot.arm.rows[i].revolute
            variable = tag("i", f"{self._units.variable(i, revolute)}\u202f+")
        marked = None if verdict is None else self._mark(i, field, verdict)
        asked = (i, field) == (self._row, self._field) and not trainer.done
        right = None if verdict is None else verdict.ok
        kind = classes("td", asked=asked, ok=right is True, no=right is False)
        return tag(kind, tag("div.var", variable, inside, marked))

    def _mark(self, i: int, field: str, verdict: CellVerdict) -> Markup:
        sign = "✓" if verdict.ok else "✕"
        ask = partial(self._ask, i, field)
        return self._form.button(f"trainer-ask-{i + 1}-{field}", sign, ask, "sign", indexed(verdict.text))

    def _about(self, trainer: Trainer) -> Inside:
        """Return the progress, and the explanation of the chosen cell."""
        if trainer.done:
            cells = trainer.exercise.n * len(FIELDS)
            return verdict_box("ok", f"All {cells} cells right", end_line(trainer))
        i, field = self._row, self._field
        name, verdict = symbol(self._units, field, i), trainer.cell_marks[i].get(field)
        if verdict is None:
            unmarked = open_line(trainer, i, field, self._units)
            line = tag("p.dim", unmarked) if unmarked else None
        else:
            line = tag("p.ok" if verdict.ok else "p.no", f"{name}: {indexed(verdict.text)}.")
        about = "The rule of this cell"
        hints = [self._foot.chip("trainer-rule", f"Hint for {name}", self._turn_rule, about, self._rule_seen)]
        if trainer.answers.cell_misses[i][FIELDS.index(field)] >= ENOUGH_MISSES and not (verdict and verdict.ok):
            put = "Fill this cell with the correct value"
            hints.append(self._foot.chip("trainer-show", f"Show {name}", ShowCell(i, field), put))
        told = tag("p", rule(trainer, i, field, self._units)) if self._rule_seen else None
        return tag("p.dim", _count(trainer)), line, tag("div.bar", hints, tag("span.dim", WHICH)), told

    def _text(self, value: float | None, field: str) -> str:
        return "" if value is None else cell_text(value, field, self._units)


def _variable(trainer: Trainer, i: int) -> str:
    return "theta" if trainer.exercise.robot.arm.rows[i].revolute else "d"


def _count(trainer: Trainer) -> str:
    answers = trainer.answers
    empty = sum(value is None for row in answers.cells for value in row)
    right = sum(verdict.ok for marks in trainer.cell_marks for verdict in marks.values())
    whole = trainer.exercise.n * len(FIELDS)
    if answers.checked_cells is None:
        return f"{whole - empty} of {whole} cells filled"
    return f"Check {answers.table_checks}: {right} of {whole} right, {empty} empty"
