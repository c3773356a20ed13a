"""The form of a step's question: one field, options, or a grid of fields, always answered with one text."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from armlab.content.question import NOT_YET, Choices, Field, Grid, Question, Verdict
from armlab.content.question import Form as Answered
from armlab.session.state import Command
from armlab.teaching.lesson_commands import Answer
from armlab.ui.erratum_links import without_links
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box

UNIT_SIGNS = {
    "deg": "°",
    "deg/s": "°/s",
    "m^2": "m²",
    "cm^2": "cm²",
    "mm^2": "mm²",
    "m/s^2": "m/s²",
    "rad/s^2": "rad/s²",
    "deg/s^2": "°/s²",
    "1/s^2": "1/s²",
    "1/m^2": "1/m²",
    "m^2/s": "m²/s",
    "Nm": "N m",
    "mNm": "mN m",
    "Ns/m": "N s/m",
}
"""Signs of units that differ from their names in lesson files."""

ANSWER, CHECK, CHOICE, ENTRY = "lesson-answer", "lesson-check", "lesson-choice-", "lesson-entry-"


MISSING = "?"
"""Text for an empty entry in a whole answer."""

_NEEDLESS = re.compile(r"\s+(?![\w.])|(?<![\w.)])\s+")
"""Spaces that do not separate two words."""

_PRODUCT = re.compile(r"(?<=[\w.)°])\s+(?=[^\W\d]|°)")
"""Spaces of a product: before a unit, a function or π, as in 2 N m or 1/2 sqrt(3)."""

_LETTER = re.compile(r"[^\W\d]")

_DECIMAL = re.compile(r"(?<=\d),(?=\d)")
_SEVERAL_VALUES = re.compile(r"(atan2|min|max)\s*\(", re.IGNORECASE)
"""Functions between whose values a comma stands."""

_PARTING = re.compile(r"[\s;,]+")
_IN_BRACKETS = re.compile(r"\([^()]*\)")


class Draft:
    """The chosen or typed parts of the answer to one question, before it is handed in.

    Parameters
    ----------
    form : Field, Choices or Grid
    typed : str
        The answer that was given last; empty for none.
    answer : callable
        Makes the command that hands in a whole answer: that of the open lesson when left out.
    at_once : bool
        Whether parts are handed in as soon as they are a whole answer, and taken back when they are none any more.

    Attributes
    ----------
    entries : dict
        By row and column, from 0: what stands in the fields of a grid, as it was typed.
    whole : str
        The whole answer, as it was handed in last.
    """

    def __init__(
        self, form: Answered, typed: str, answer: Callable[[str], Command] = Answer, at_once: bool = False
    ) -> None:
        self._form, self._answer, self._at_once = form, answer, at_once
        self.whole = typed
        self.chosen = {int(word) for word in typed.replace(",", " ").split() if word.isdecimal()}
        rows = [row.split() for row in typed.split(";")]
        self.entries: dict[tuple[int, int], str] = {}
        if isinstance(form, Grid) and [len(row) for row in rows] == [form.columns] * form.rows:
            entries = {(i, j): entry for i, row in enumerate(rows) for j, entry in enumerate(row)}
            self.entries = {place: entry for place, entry in entries.items() if entry != MISSING}

    def send(self, text: str) -> Command:
        """Hand in the text of a single field."""
        self.whole = text
        return self._answer(text)

    def choose(self, option: int) -> Command | None:
        """Choose an option, or cancel its choice; return the answer if that is one."""
        if isinstance(self._form, Choices) and not self._form.several:
            return self._answer(str(option))
        self.chosen ^= {option}
        return self._sent()

    def enter(self, i: int, j: int, text: str) -> Command | None:
        """Fill in an entry of a grid; return the answer if that is one."""
        self.entries[i, j] = text
        return self._sent()

    def hand_in(self) -> Command | tuple[()]:
        """Return the whole answer, or none for a single field, which has sent its own."""
        whole = self._whole()
        return () if whole is None else self.send(whole)

    def _sent(self) -> Command | None:
        """Return the command that keeps up with the parts, if there is to be one and anything has changed by them."""
        whole = self._whole() if self._is_whole() else ""
        return None if not self._at_once or whole is None or whole == self.whole else self.send(whole)

    def _is_whole(self) -> bool:
        """Return whether an option is chosen, or nothing in a grid is empty."""
        if not isinstance(self._form, Grid):
            return bool(self.chosen)
        rows, columns = range(self._form.rows), range(self._form.columns)
        return all(_entry(self.entries.get((i, j), "")) for i in rows for j in columns)

    def _whole(self) -> str | None:
        if isinstance(self._form, Choices):
            return ",".join(map(str, sorted(self.chosen)))
        if isinstance(self._form, Grid):
            rows, columns = range(self._form.rows), range(self._form.columns)
            return "; ".join(" ".join(_entry(self.entries.get((i, j), "")) or MISSING for j in columns) for i in rows)
        return None


def _entry(text: str) -> str:
    """Return an entry of a matrix in a form that cannot be read as several entries.

    >>> _entry(" 1 / 2 "), _entry("sqrt(0,5)"), _entry("atan2(1, 2)"), _entry("1 0; 0 1"), _entry("2 N m")
    ('1/2', 'sqrt(0.5)', 'atan2(1,2)', '(1,0,0,1)', '2N*m')
    >>> _entry("1/2 sqrt(3)"), _entry("2 π rad"), _entry("2 m s^-1")
    ('1/2sqrt(3)', '2π*rad', '2m*s^-1')
    """
    text = _PRODUCT.sub(_times, _NEEDLESS.sub("", text.strip()))
    if not _SEVERAL_VALUES.search(text):
        text = _DECIMAL.sub(".", text)
    if _PARTING.search(_IN_BRACKETS.sub("", text)):
        # Several numbers in one field: kept together, so that the verdict names this field.
        text = f"({_PARTING.sub(',', text)})"
    return text


def _times(space: re.Match[str]) -> str:
    """Return the sign of a product for a space, none between a number and the first word behind it."""
    return "*" if _LETTER.search(space.string, 0, space.start()) else ""


def asked(
    form: Form,
    question: Question,
    typed: str,
    draft: Draft,
    settled: bool,
    order: Sequence[int] = (),
    word: str = "Check",
    of: str = "",
) -> Markup:
    """Return the question with its controls for an answer.

    Parameters
    ----------
    form : Form
    question : Question
    typed : str
        The last answer.
    draft : Draft
    settled : bool
        Whether the answer counts and cannot be changed.
    order : sequence of int, optional
        In which options are shown, from 1.
    word : str
        On the button that hands the answer in.
    of : str
        Names the question: what is typed for one is not taken for an answer to another, whose fields are called the
        same.
    """
    note = "Your prediction is noted." if settled else "Predict: your first answer counts."
    check = None if settled else form.button(CHECK, word, draft.hand_in, "chip")
    fields = _form(form, question.form, typed, draft, settled, check, order)
    prediction = tag("p.dim", note) if question.hide else None
    return tag("div.ask", without_links(question.html), prediction, fields, data_of=of or None)


def _form(
    form: Form, kind: Answered, typed: str, draft: Draft, settled: bool, check: Markup | None, order: Sequence[int]
) -> Inside:
    if isinstance(kind, Field):
        unit = UNIT_SIGNS.get(kind.unit, kind.unit)
        label = f"Your answer in {unit}" if unit else "Your answer"
        line = form.field(
            ANSWER, typed, label, draft.send, off=settled, inputmode="", spellcheck="false", placeholder="your answer"
        )
        return tag("div.answer", line, tag("i", unit), check)
    if isinstance(kind, Choices):
        return _choices(form, kind, draft, settled, check if kind.several else None, order)
    return _grid(form, kind, draft, settled, check)


def _choices(
    form: Form, kind: Choices, draft: Draft, settled: bool, check: Markup | None, order: Sequence[int]
) -> Inside:
    def offered(k: int) -> Markup:
        chosen, said = k in draft.chosen, without_links(kind.options[k - 1])
        return form.button(f"{CHOICE}{k}", said, lambda: draft.choose(k), "choice", pressed=chosen, off=settled)

    hint = tag("p.dim", "Choose all that apply.") if kind.several else None
    return hint, tag("div.choices", map(offered, order or range(1, len(kind.options) + 1))), check


def _grid(form: Form, kind: Grid, draft: Draft, settled: bool, check: Markup | None) -> Inside:
    def entry(i: int, j: int) -> Markup:
        label, value = f"Row {i + 1}, column {j + 1}", draft.entries.get((i, j), "")
        after = divmod(i * kind.columns + j + 1, kind.columns)
        below = f"{ENTRY}{after[0]}-{after[1]}" if after[0] < kind.rows else CHECK
        return form.field(
            f"{ENTRY}{i}-{j}", value, label, lambda text: draft.enter(i, j, text), below, settled, inputmode=""
        )

    rows = [tag("div", [entry(i, j) for j in range(kind.columns)]) for i in range(kind.rows)]
    unit = tag("i", UNIT_SIGNS.get(kind.unit, kind.unit)) if kind.unit else None
    return tag("div.entries", rows), tag("div.answer", unit, check)


def said(
    verdict: Verdict | None, settled: bool = False, stays: str = "", done: bool = True, right: Inside = None
) -> Markup | None:
    """Return the verdict on the last answer, or nothing before there is one.

    Parameters
    ----------
    verdict : Verdict or None
    settled : bool
        Whether the answer counts and cannot be changed.
    stays : str
        An earlier answer that was right, and counts.
    done : bool
        Whether all of the step is done.
    right : optional
        The right answer, to be told when the step is done to one who cannot correct the own; None to tell it never.
    """
    if verdict is None:
        return None
    if verdict.right:
        return verdict_box("ok", Markup(verdict.says), role="status")
    if settled:
        return _missed(verdict, done, right)
    head = "Not right" if stays else "Not yet"
    remains = ": the step remains done." if done else "."
    kept = tag("p.dim", f"Your earlier answer {stays} was right and counts{remains}") if stays else None
    return verdict_box("no", head, without_links(verdict.says), kept, role="status")


def _missed(verdict: Verdict, done: bool, right: Inside) -> Markup:
    """Return the verdict on a wrong prediction: nothing of it asks for another one."""
    says = None if verdict.says == NOT_YET else without_links(verdict.says)
    if right is not None and not done:
        right = tag("p.dim", "The right answer is shown here when the step is done.")
    return verdict_box("no", "Not as predicted", says, right, role="status")
