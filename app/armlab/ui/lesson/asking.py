"""How the question of a step is asked: one field, options, or a grid of fields; always answered with one text."""

from __future__ import annotations

import re
from collections.abc import Sequence

from armlab.content.question import Choices, Field, Grid, Question, Verdict
from armlab.content.question import Form as Answered
from armlab.session.lesson_commands import Answer
from armlab.ui.form import Form
from armlab.ui.format import escaped

UNIT_SIGNS = {"deg": "°", "m^2": "m²", "cm^2": "cm²", "mm^2": "mm²", "Nm": "N m"}
"""How units are written where they are not so in lesson files."""

ANSWER, CHECK, CHOICE, ENTRY = "lesson-answer", "lesson-check", "lesson-choice-", "lesson-entry-"


MISSING = "?"
"""What stands in a whole answer for an entry that is empty."""

_NEEDLESS = re.compile(r"\s+(?![\w.])|(?<![\w.)])\s+")
"""Spaces that stand between no two words."""

_UNIT = re.compile(r"(?<=[\d.)])\s+(?=[a-zA-Z°][\w/^°]*$)")
"""Spaces between a number and its unit."""

_DECIMAL = re.compile(r"(?<=\d),(?=\d)")
_PARTING = re.compile(r"[\s;,]+")
_IN_BRACKETS = re.compile(r"\([^()]*\)")


class Draft:
    """What has been chosen or filled in and not yet handed in, of one question.

    Parameters
    ----------
    form : Field, Choices or Grid
    typed : str
        The answer that was given last; empty for none.

    Attributes
    ----------
    entries : dict
        By row and column, from 0: what stands in the fields of a grid, as it was typed.
    whole : str
        The whole answer, as it was handed in last.
    """

    def __init__(self, form: Answered, typed: str) -> None:
        self._form = form
        self.whole = typed
        self.chosen = {int(word) for word in typed.replace(",", " ").split() if word.isdecimal()}
        rows = [row.split() for row in typed.split(";")]
        self.entries: dict[tuple[int, int], str] = {}
        if isinstance(form, Grid) and [len(row) for row in rows] == [form.columns] * form.rows:
            entries = {(i, j): entry for i, row in enumerate(rows) for j, entry in enumerate(row)}
            self.entries = {place: entry for place, entry in entries.items() if entry != MISSING}

    def choose(self, option: int) -> Answer | None:
        """Choose an option, or no longer; the answer where one is enough."""
        if isinstance(self._form, Choices) and not self._form.several:
            return Answer(str(option))
        self.chosen ^= {option}
        return None

    def enter(self, i: int, j: int, text: str) -> None:
        """Fill in an entry of a grid."""
        self.entries[i, j] = text

    def hand_in(self) -> Answer | tuple[()]:
        """Return the whole answer; none of one field, which has told already."""
        whole = self._whole()
        if whole is None:
            return ()
        self.whole = whole
        return Answer(whole)

    def _whole(self) -> str | None:
        if isinstance(self._form, Choices):
            return ",".join(map(str, sorted(self.chosen)))
        if isinstance(self._form, Grid):
            rows, columns = range(self._form.rows), range(self._form.columns)
            return "; ".join(" ".join(_entry(self.entries.get((i, j), "")) or MISSING for j in columns) for i in rows)
        return None


def _entry(text: str) -> str:
    """Return an entry of a matrix without what would part it from its neighbours or in two.

    >>> _entry(" 1 / 2 "), _entry("0,5"), _entry("atan2(1, 2)"), _entry("1 0; 0 1"), _entry("50 cm")
    ('1/2', '0.5', 'atan2(1,2)', '(1,0,0,1)', '50cm')
    """
    text = _UNIT.sub("", _NEEDLESS.sub("", text.strip()))
    if "(" not in text:
        text = _DECIMAL.sub(".", text)
    if _PARTING.search(_IN_BRACKETS.sub("", text)):
        # Several numbers in one field: kept together, so that the verdict names this field.
        text = f"({_PARTING.sub(',', text)})"
    return text


def asked(form: Form, question: Question, typed: str, draft: Draft, settled: bool, order: Sequence[int] = ()) -> str:
    """Return the question with what it is answered with.

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
    """
    note = ""
    if question.hide:
        said = "Your prediction is noted." if settled else "Predict: your first answer counts."
        note = f'<p class="dim">{said}</p>'
    return f'<div class="ask">{question.html}{note}{_form(form, question.form, typed, draft, settled, order)}</div>'


def _form(form: Form, kind: Answered, typed: str, draft: Draft, settled: bool, order: Sequence[int]) -> str:
    check = "" if settled else form.button(CHECK, "Check", draft.hand_in, "chip")
    if isinstance(kind, Field):
        unit = escaped(UNIT_SIGNS.get(kind.unit, kind.unit))
        label = f"Your answer in {unit}" if unit else "Your answer"
        line = form.field(
            ANSWER, typed, label, Answer, off=settled, inputmode="", spellcheck="false", placeholder="your answer"
        )
        return f'<div class="answer">{line}<i>{unit}</i>{check}</div>'
    if isinstance(kind, Choices):
        return _choices(form, kind, draft, settled, check if kind.several else "", order)
    return _grid(form, kind, draft, settled, check)


def _choices(form: Form, kind: Choices, draft: Draft, settled: bool, check: str, order: Sequence[int]) -> str:
    def offered(k: int) -> str:
        chosen, said = k in draft.chosen, kind.options[k - 1]
        return form.button(f"{CHOICE}{k}", said, lambda: draft.choose(k), "choice", pressed=chosen, off=settled)

    hint = '<p class="dim">Choose all that hold.</p>' if kind.several else ""
    return f'{hint}<div class="choices">{"".join(map(offered, order or range(1, len(kind.options) + 1)))}</div>{check}'


def _grid(form: Form, kind: Grid, draft: Draft, settled: bool, check: str) -> str:
    def entry(i: int, j: int) -> str:
        label, value = f"Row {i + 1}, column {j + 1}", draft.entries.get((i, j), "")
        return form.field(
            f"{ENTRY}{i}-{j}", value, label, lambda text: draft.enter(i, j, text), off=settled, inputmode=""
        )

    rows = [f"<div>{''.join(entry(i, j) for j in range(kind.columns))}</div>" for i in range(kind.rows)]
    unit = f"<i>{escaped(UNIT_SIGNS.get(kind.unit, kind.unit))}</i>" if kind.unit else ""
    return f'<div class="entries">{"".join(rows)}</div><div class="answer">{unit}{check}</div>'


def said(verdict: Verdict | None, settled: bool = False, stays: str = "") -> str:
    """Return the verdict on the last answer; nothing before one is given.

    Parameters
    ----------
    verdict : Verdict or None
    settled : bool
        Whether the answer counts and cannot be changed.
    stays : str
        An earlier answer that was right: with it the step stays done.
    """
    if verdict is None:
        return ""
    if verdict.right:
        return f'<div class="verdict ok" role="status"><b>✓ {verdict.says}</b></div>'
    head = "Not as predicted" if settled else "Not right" if stays else "Not yet"
    kept = (
        f'<p class="dim">Your answer {escaped(stays)} was right and counts: the step stays done.</p>' if stays else ""
    )
    return f'<div class="verdict no" role="status"><b>✕ {head}</b>{verdict.says}{kept}</div>'
