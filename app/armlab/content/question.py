"""What a question of a lesson is: what is asked, how it is answered, and the verdict on an answer.

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
"""Makes HTML of Markdown; the second argument is its key in the file."""

HIDDEN = ("arm", "values")
"""What a question may hide until it is answered."""

NOT_YET = "This is not the answer yet."


@dataclass(frozen=True)
class Verdict:
    """Whether an answer is right.

    Attributes
    ----------
    right : bool
    says : str
        What there is to say about it, as HTML.
    name : str
        A short name of the mistake, for counting: such as ``sign``, ``unit`` or ``wrong[2]`` for the second table
        ``wrong`` of the question; empty where none is known.
    """

    right: bool
    says: str
    name: str = ""


RIGHT = Verdict(True, "Right.")


def unreadable(problem: object) -> Verdict:
    """Return the verdict on what cannot be read; the problem is plain text."""
    text = str(problem)
    return Verdict(False, escape(text[:1].upper() + text[1:], quote=False), "unreadable")


@dataclass(frozen=True)
class Field:
    """One line of text. ``unit`` is what a number without a unit is taken in; empty for none."""

    unit: str = ""


@dataclass(frozen=True)
class Choices:
    """Options (HTML) to choose one of, or several; where they are ``fixed``, in this order in every variant."""

    options: tuple[str, ...]
    several: bool
    fixed: bool = False

    def order(self, variant: int, name: str) -> tuple[int, ...]:
        """Return the options, from 1, in the order in which a variant shows them; variant 0 as they are written.

        Parameters
        ----------
        variant : int
        name : str
            Of the step: another question has another order.
        """
        order = list(range(1, len(self.options) + 1))
        if variant and not self.fixed:
            random.Random(f"{variant} {name}").shuffle(order)
        return tuple(order)


@dataclass(frozen=True)
class Grid:
    """A matrix of so many rows and columns; its entries are in ``unit``."""

    rows: int
    columns: int
    unit: str = ""


Form = Field | Choices | Grid


class Wrong(NamedTuple):
    """A wrong answer a lesson expects, as typed, and what it says to it (HTML)."""

    typed: str
    says: str


class Question(Protocol):
    """A question of any kind."""

    @property
    def html(self) -> str:
        """What is asked."""
        ...

    @property
    def form(self) -> Form:
        """How it is answered."""
        ...

    @property
    def hide(self) -> tuple[str, ...]:
        """What is hidden until an answer is given: some of `HIDDEN`."""
        ...

    @property
    def right_answer(self) -> str:
        """An answer that is right, as typed."""
        ...

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers the lesson names."""
        ...

    def judge(self, text: str) -> Verdict:
        """Return the verdict on an answer as typed; what cannot be read is a verdict as well."""
        ...


@dataclass(frozen=True)
class Asked:
    """What the tables of all kinds have: the question as HTML, and what it hides."""

    html: str
    hide: tuple[str, ...] = ()


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


def read_question(table: Table, to_html: ToHtml) -> Question:
    """Read the table of a question of any kind.

    Parameters
    ----------
    table : Table
        ``kind``, ``text``, ``hide`` and the fields of the kind.
    to_html : callable
        Makes HTML of Markdown; the second argument is its key in the file.

    Raises
    ------
    ContentError
        An unknown kind, a missing, wrong or unknown field.
    """
    kind = question_types()[table.choice("kind", question_types())]
    asked = Asked(to_html(table.text("text"), f"{table.where}.text"), _hidden(table))
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
