"""Questions of lessons: the text, the form of the answer, and the verdict on an answer.

An answer is always one text, as typed: ``0.5 m``; ``2`` or ``1,3`` for options; ``1 0; 0 1`` for a matrix.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from html import escape
from typing import NamedTuple, Protocol

from armlab.content.reader import Table, shown
from armlab.plugins import discover

ToHtml = Callable[[str, str], str]
"""A function from Markdown, and its key in the file, to HTML."""

HIDDEN = ("arm", "values")
"""Parts of the screen that a question may hide until it is answered."""

UNREADABLE, OTHER_QUANTITY = "unreadable", "quantity"
"""Names of what is no answer."""

NOT_YET = "This is not the answer yet."


@dataclass(frozen=True)
class Verdict:
    """The verdict on an answer.

    Attributes
    ----------
    right : bool
    says : str
        Sentence on the answer, as HTML.
    name : str
        A short name of the mistake, for counting: such as ``sign``, ``unit`` or ``wrong[2]`` for the second table
        ``wrong`` of the question; empty where none is known.
    """

    right: bool
    says: str
    name: str = ""

    @property
    def counts(self) -> bool:
        """Whether it is on an answer, right or wrong: none is what cannot be read, or another quantity than asked."""
        return self.name not in (UNREADABLE, OTHER_QUANTITY)


RIGHT = Verdict(True, "Right.")


def unreadable(problem: object) -> Verdict:
    """Return the verdict on an unreadable answer; the problem is plain text."""
    text = str(problem)
    return Verdict(False, escape(text[:1].upper() + text[1:], quote=False), UNREADABLE)


@dataclass(frozen=True)
class Field:
    """One line of text. ``unit`` is assumed for a number without one; empty for none."""

    unit: str = ""


@dataclass(frozen=True)
class Choices:
    """Options (HTML), one or several of which are chosen; ``fixed`` ones have the same order in every variant."""

    options: tuple[str, ...]
    several: bool
    fixed: bool = False

    def order(self, variant: int, name: str) -> tuple[int, ...]:
        """Return the options, from 1, in the order in which a variant shows them; variant 0 as they are written.

        Parameters
        ----------
        variant : int
        name : str
            Name of the step: the order differs between questions.
        """
        order = list(range(1, len(self.options) + 1))
        if variant and not self.fixed:
            random.Random(f"{variant} {name}").shuffle(order)
        return tuple(order)


@dataclass(frozen=True)
class Grid:
    """A matrix with given numbers of rows and columns; its entries are in ``unit``."""

    rows: int
    columns: int
    unit: str = ""


Form = Field | Choices | Grid


class Wrong(NamedTuple):
    """A wrong answer that a lesson expects, as typed, and the lesson's text on it (HTML)."""

    typed: str
    says: str


class Question(Protocol):
    """A question of any kind."""

    @property
    def html(self) -> str:
        """The text of the question."""
        ...

    @property
    def form(self) -> Form:
        """The form of the answer."""
        ...

    @property
    def hide(self) -> tuple[str, ...]:
        """Parts that are hidden until an answer is given: some of `HIDDEN`."""
        ...

    @property
    def right_answer(self) -> str:
        """A right answer, as typed."""
        ...

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers that the lesson names."""
        ...

    def judge(self, text: str) -> Verdict:
        """Return the verdict on an answer as typed, also on an unreadable one."""
        ...


@dataclass(frozen=True)
class Asked:
    """The common fields of all kinds.

    Attributes
    ----------
    html : str
        The text of the question.
    hide : tuple of str
        The parts of the screen that it hides.
    drawn : bool
        Whether its numbers are those of another variant than the one that the author sees.
    """

    html: str
    hide: tuple[str, ...] = ()
    drawn: bool = False

    def check_apart(self, wrong: Table, near: bool, says: str) -> None:
        """Raise `ContentError` where a wrong answer is near the right one.

        In a variant that was drawn it may be so by chance: there a mistake leads to what is right, and is right.
        """
        if near and not self.drawn:
            raise wrong.fail("answer", says)


@dataclass(frozen=True)
class QuestionType:
    """One kind of question, the constant ``QUESTION`` of a module in `armlab.content.questions`.

    Parameters
    ----------
    key : str
        The ``kind`` in lesson files.
    order : int
        Place in lists.
    read : callable
        ``read(table, asked, to_html) -> Question``: takes the fields of the kind from the table; the caller takes
        ``kind``, ``text`` and ``hide`` and reports what is left over.
    """

    key: str
    order: int
    read: Callable[[Table, Asked, ToHtml], Question]


@cache
def question_types() -> dict[str, QuestionType]:
    """Return all kinds of questions by key."""
    from armlab.content import questions as folder

    return discover(folder, "QUESTION", QuestionType)


def read_question(table: Table, to_html: ToHtml, drawn: bool = False) -> Question:
    """Read the table of a question of any kind.

    Parameters
    ----------
    table : Table
        ``kind``, ``text``, ``hide`` and the fields of the kind.
    to_html : callable
        Makes HTML of Markdown; the second argument is its key in the file.
    drawn : bool, optional
        See `Asked`.

    Raises
    ------
    ContentError
        An unknown kind, a missing, wrong or unknown field.
    """
    kind = question_types()[table.choice("kind", question_types())]
    asked = Asked(to_html(table.text("text"), f"{table.where}.text"), _hidden(table), drawn)
    question = kind.read(table, asked, to_html)
    table.done()
    return question


def says(entry: Table, to_html: ToHtml) -> str:
    """Take ``says``, Markdown, of a table ``wrong``."""
    return to_html(entry.text("says"), f"{entry.where}.says")


def _hidden(table: Table) -> tuple[str, ...]:
    hidden = table.value("hide", [])
    if not isinstance(hidden, list) or not all(name in HIDDEN for name in hidden):
        raise table.fail("hide", f"expected a list of {' or '.join(map(repr, HIDDEN))}, got {shown(hidden)}")
    return tuple(dict.fromkeys(hidden))
