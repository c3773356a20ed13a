"""The second stage of the trainer: the table, its marks, and the rule of a cell."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from armlab.benches.robot.trainer.answers import FIELDS
from armlab.benches.robot.trainer.commands import ENOUGH_MISSES, CheckTable, ReviseAxes, SetAnswer, ShowCell
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.axes import shown_direction
from armlab.benches.robot.trainer.ui.words import end_line, parallel_line, reversed_line, rule, symbol
from armlab.kin.assignment import CellVerdict
from armlab.session.state import Post
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form, Wish
from armlab.ui.format import dot, escaped, subscript
from armlab.ui.tables import cell_text, without_symbol
from armlab.ui.units import NAMES, Units
from armlab.ui.widgets import Gui

TURNS = ("alpha", "theta")
WHICH = '<span class="dim">press the head of a row or column to choose the cell</span>'


class TableStage:
    """The table of one panel, and which of its cells is asked about.

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
        self._frame = ""
        self._on_page: dict[str, str] = {}

    def show(self, trainer: Trainer) -> None:
        """Show the stage."""
        self._trainer = trainer
        if self._checks is not None and trainer.answers.table_checks > self._checks:
            self._turn_to_wrong(trainer)
        self._checks = trainer.answers.table_checks
        self._row = min(self._row, trainer.exercise.n - 1)
        self._show_table(trainer)
        hint = "Mark the cells that are filled"
        check = "" if trainer.done else self._check.button("trainer-check", "Check table", CheckTable(), "main", hint)
        self._check.show(check)
        self._foot.show(self._about(trainer))

    def hide(self) -> None:
        """Show nothing."""
        self._frame, self._on_page = "", {}
        for form in (self._form, self._check, self._foot):
            form.show("")

    def _show_table(self, trainer: Trainer) -> None:
        """Show the table unless the page shows it already: a person may be typing in its next cell."""
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
        """Ask about the first wrong cell, unless the one asked about is wrong."""
        wrong = [
            (i, field)
            for i, marks in enumerate(trainer.cell_marks)
            for field in self._units.book.order
            if field in marks and not marks[field].ok
        ]
        if wrong and (self._row, self._field) not in wrong:
            self._row, self._field = wrong[0]

    # -- markup --------------------------------------------------------------------------------------------------

    def frames(self, form: Form, trainer: Trainer) -> str:
        """Return the frames the table is about, and what is to be known of them; ``form`` gets the button."""
        assert trainer.assignment is not None
        rows = []
        for i, ((z, x), frame) in enumerate(zip(trainer.answers.axes, trainer.assignment.frames, strict=True)):
            place = "".join(f"<td>{cell_text(float(value), 'd', self._units)}</td>" for value in frame[:3, 3])
            axes = "".join(f'<td class="axis-{axis}">{shown_direction(way)}</td>' for axis, way in (("z", z), ("x", x)))
            rows.append(f"<tr><td>{{{i}}}</td>{place}{axes}</tr>")
        remarks = (reversed_line(trainer, self._units), parallel_line(trainer))
        back = form.button("trainer-revise", "change", ReviseAxes(), "copy", "Go back to the axes; the table is kept")
        return (
            f'<h3>Frames as you placed them<span class="copies">{back}</span></h3><table class="dh tr-frames"><tr>'
            f"<th>frame</th><th colspan=3>origin x, y, z in {self._units.length_unit}</th><th>z</th><th>x</th></tr>"
            f"{''.join(rows)}</table>" + "".join(f'<p class="dim">{remark}</p>' for remark in remarks if remark)
        )

    def _heads(self) -> str:
        heads = []
        for field in self._units.book.order:
            inside = self._units.column(field, "standard")
            ask = partial(self._ask, field=field)
            heads.append(f"<th>{self._form.button(f'trainer-column-{field}', inside, ask, 'head', NAMES[field])}</th>")
        return "".join(heads)

    def _table(self, trainer: Trainer, texts: Mapping[str, str]) -> str:
        lines = "".join(self._line(trainer, i, texts) for i in range(trainer.exercise.n))
        return f'<table class="dh edit tr-table"><tr><th>joint</th>{self._heads()}</tr>{lines}</table>'

    def _line(self, trainer: Trainer, i: int, texts: Mapping[str, str]) -> str:
        kind = trainer.exercise.robot.arm.rows[i].kind
        name = f"{dot(css(joint_colour(i)))}{subscript(kind, i + 1)}"
        ask = partial(self._ask, i)
        head = self._form.button(f"trainer-row-{i + 1}", name, ask, "head", f"Ask about row {i + 1}")
        cells = "".join(self._cell(trainer, i, field, texts[f"{i + 1}-{field}"]) for field in self._units.book.order)
        return f"<tr><td>{head}</td>{cells}</tr>"

    def _cell(self, trainer: Trainer, i: int, field: str, text: str) -> str:
        verdict = trainer.cell_marks[i].get(field)
        label = f"row {i + 1}, {NAMES[field]}"
        inside = self._form.field(f"trainer-cell-{i + 1}-{field}", text, label, partial(self._typed, i, field))
        if field == _variable(trainer, i):
            revolute = trainer.exercise.robot.arm.rows[i].revolute
            inside = f"<i>{self._units.variable(i, revolute)}&#8239;+</i>{inside}"
        if verdict is not None:
            inside += self._mark(i, field, verdict)
        classes = "asked" if (i, field) == (self._row, self._field) and not trainer.done else ""
        classes += "" if verdict is None else (" ok" if verdict.ok else " no")
        return f'<td class="{classes.strip()}"><div class="var">{inside}</div></td>'

    def _mark(self, i: int, field: str, verdict: CellVerdict) -> str:
        sign = "✓" if verdict.ok else "✕"
        ask = partial(self._ask, i, field)
        return self._form.button(f"trainer-ask-{i + 1}-{field}", sign, ask, "sign", verdict.text)

    def _about(self, trainer: Trainer) -> str:
        """Return how far it is, and what there is to say about the cell asked about."""
        if trainer.done:
            cells = trainer.exercise.n * len(FIELDS)
            return f'<div class="verdict ok"><b>✓ All {cells} cells right</b>{end_line(trainer)}</div>'
        i, field = self._row, self._field
        name, verdict = symbol(self._units, field, i), trainer.cell_marks[i].get(field)
        line = ""
        if verdict is not None:
            line = f'<p class="{"ok" if verdict.ok else "no"}">{name}: {escaped(verdict.text)}.</p>'
        told = "The rule of this cell"
        hint = self._foot.chip("trainer-rule", f"Hint for {name}", self._turn_rule, told, self._rule_seen)
        if trainer.answers.cell_misses[i][FIELDS.index(field)] >= ENOUGH_MISSES and not (verdict and verdict.ok):
            put = "Put the right value into this cell"
            hint += self._foot.chip("trainer-show", f"Show {name}", ShowCell(i, field), put)
        told = f"<p>{rule(trainer, i, field, self._units)}</p>" if self._rule_seen else ""
        return f'<p class="dim">{_count(trainer)}</p>{line}<div class="bar">{hint}{WHICH}</div>{told}'

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
    return f"{right} of {whole} right, {empty} empty, check {answers.table_checks}"
