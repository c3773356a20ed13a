"""The form of a new arm: its rows as fields, or a table pasted from a book, a spreadsheet or a program."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS
from armlab.kin.dh import CONVENTIONS, Row
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form, Wish
from armlab.ui.format import dot
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row as line
from armlab.ui.tables import is_variable
from armlab.ui.units import NAMES
from armlab.window.arms.draft import Draft, TypedRow

BOOKS = {"standard": "Standard (Siciliano, Spong)", "modified": "Modified (Craig)"}
KINDS = {"R": "R", "P": "P"}
PLACEHOLDER = "a\talpha\td\ttheta\n0.3\t90\t0.2\tq1\n0.25\t0\t0\tq2 + 30"
NOTHING = (
    "The new arm takes nothing over from the {name}: neither tool nor limits nor name. Undo brings the {name} back."
)
LIMITS = (
    "Revolute joints get limits of ±180° and prismatic ones of 0 to 1 m; "
    "other limits can be typed on the page DH table."
)


class NewArmForm:
    """The form of one page.

    Parameters
    ----------
    form : Form
    draft : Draft
    done : callable
        Called before the command of the finished arm is handed in; what it returns does not count.
    """

    def __init__(self, form: Form, draft: Draft, done: Callable[[], object]) -> None:
        self._form, self._draft, self._done = form, draft, done
        self._pasted, self._refused = "", ""

    def markup(self, present: str) -> Inside:
        """Return the form; ``present`` is the name of the arm on the table."""
        form, draft = self._form, self._draft
        named = form.field("new-name", draft.name, "Name", self._named, inputmode="", placeholder="My arm")
        heads = [tag("th", draft.units.column(name, draft.convention)) for name in draft.units.book.order]
        head = tag("tr", tag("th", "joint"), tag("th", "R: revolute, P: prismatic"), heads, tag("th"))
        rows = [self._row(typed, i) for i, typed in enumerate(draft.rows)]
        full = len(draft.rows) == MAX_JOINTS
        add = form.chip("new-add", "+ joint", self._add, "Add a row at the end", off=full)
        return (
            line("Name", named, wide=True),
            line("Table", form.chips("new-book", BOOKS, draft.convention, "", self._book), wide=True),
            line("Numbers in", self._units(), wide=True),
            tag("div.scroll", tag("table.dh.rows", head, rows)),
            tag("div.bar", add, tag("span.dim", LIMITS)),
            self._paste_box(),
            tag("p.dim", NOTHING.format(name=present)),
            tag("div.bar", form.button("new-make", "Use this arm", self._make, "main")),
        )

    def _row(self, typed: TypedRow, i: int) -> list[Markup]:
        form, draft = self._form, self._draft
        kind = form.chips(f"new-{i}-kind", KINDS, typed.kind, "R: revolute, P: prismatic", partial(self._kind, i))
        remove, off = f"Remove joint {i + 1}", len(draft.rows) == 1
        gone = form.button(f"new-{i}-gone", "✕", partial(self._gone, i), "copy", remove, remove, off=off)
        name = tag("td", dot(css(joint_colour(i))), str(i + 1))
        cells = [self._cell(typed, i, field) for field in draft.units.book.order]
        made = [tag("tr", name, tag("td", tag("div.chips", kind)), cells, tag("td", gone))]
        if typed.wrong:
            told = tag("p.no", f"✕ joint {i + 1}: {typed.wrong}", role="alert")
            made.append(tag("tr", tag("td", told, colspan=3 + len(cells))))
        return made

    def _cell(self, typed: TypedRow, i: int, field: str) -> Markup:
        variable = is_variable(Row(typed.kind), field)
        label = f"joint {i + 1}, {NAMES[field]}" + (", offset of the joint variable" if variable else "")
        more: dict[str, Any] = {"placeholder": "0", "inputmode": ""}
        if typed.where == field:
            more |= {"aria_invalid": "true", "title": typed.wrong}
        write, below = partial(self._write, i, field), f"new-{i + 1}-{field}"
        inside = self._form.field(f"new-{i}-{field}", typed.texts[field], label, write, below, **more)
        if not variable:
            return tag("td", inside)
        return tag("td", tag("div.var", tag("i", self._draft.units.variable(i, typed.kind == "R"), " +"), inside))

    def _units(self) -> Inside:
        form, notation = self._form, self._draft.units.notation
        return (
            form.chips("new-length", {"mm": "mm", "m": "m"}, notation.length, "Lengths", partial(self._unit, "length")),
            form.chips("new-angle", {"deg": "°", "rad": "rad"}, notation.angle, "Angles", partial(self._unit, "angle")),
            tag("span.dim", "also 0.4 m, 90° or pi/2"),
        )

    def _paste_box(self) -> Markup:
        looks: dict[str, Any] = {
            "rows": 4,
            "spellcheck": "false",
            "aria_label": "Table to paste",
            "placeholder": PLACEHOLDER,
        }
        area = tag("textarea.paste", self._pasted, **looks, **self._form.bound("new-paste", self._paste))
        told: Inside = [tag("p.dim", note) for note in self._draft.notes]
        if self._refused:
            told = tag("p.no", f"✕ {self._refused}", role="alert")
        head = tag("b", "Or paste a whole table"), tag("span.dim", " from a spreadsheet, CSV, Markdown or LaTeX")
        return tag("div.pasting", tag("p", head), area, told)

    # -- what a person does: it changes this page only, until the arm is put on the table --------------------------

    def _named(self, text: str) -> Wish:
        self._draft.set_name(text)
        return None

    def _book(self, convention: str) -> Wish:
        self._draft.convention = next(each for each in CONVENTIONS if each == convention)
        return None

    def _unit(self, name: str, unit: str) -> Wish:
        self._draft.set_unit(name, unit)
        return None

    def _write(self, i: int, field: str, text: str) -> Wish:
        self._draft.write(i, field, text)
        return None

    def _kind(self, i: int, kind: str) -> Wish:
        self._draft.set_kind(i, "P" if kind == "P" else "R")
        return None

    def _add(self) -> Wish:
        self._draft.add()
        return None

    def _gone(self, i: int) -> Wish:
        self._draft.remove(i)
        return None

    def _paste(self, text: str) -> Wish:
        self._pasted, self._refused = text, ""
        try:
            self._draft.paste(text)
            self._pasted = ""
        except InputError as error:
            self._refused = str(error)
        return None

    def _make(self) -> Wish:
        command = self._draft.command()
        if command is not None:
            self._done()
        return command
