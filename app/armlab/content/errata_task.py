"""Tasks on errata: find the wrong part of what is printed, then give the correct form."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from armlab.content.errata import FILE, Erratum, errata, erratum
from armlab.content.markdown import to_html
from armlab.content.question import Choices, Question, read_question
from armlab.content.reader import Table, shown
from armlab.errors import ContentError

SO_PRINTED = "This is how it is printed."

Place = tuple[int, ...]
"""A part of what is printed, from 1: its number, or its row and column."""


@dataclass(frozen=True)
class Task:
    """The task of one erratum.

    Attributes
    ----------
    key : str
        Id of the erratum.
    parts : tuple of tuples of str
        Parts of what is printed, as HTML: one line, or the rows of a matrix.
    in_rows : bool
        Whether they are a matrix.
    at : frozenset of Place
        The wrong parts.
    question : Question
        What is asked for then.
    """

    key: str
    parts: tuple[tuple[str, ...], ...]
    in_rows: bool
    at: frozenset[Place]
    question: Question

    @property
    def of_texts(self) -> bool:
        """Whether the correction is a choice among texts: there is no formula to type."""
        return isinstance(self.question.form, Choices)

    def place(self, row: int, column: int) -> Place:
        """Return how a part is named, from its row and column, counted from 0."""
        return (row + 1, column + 1) if self.in_rows else (column + 1,)

    @property
    def places(self) -> tuple[Place, ...]:
        """All parts in order."""
        return tuple(self.place(i, k) for i, row in enumerate(self.parts) for k in range(len(row)))


def read_task(each: Erratum) -> Task:
    """Read the task of an erratum.

    Raises
    ------
    ContentError
        It has none, or a key of it is missing, wrong or unknown.
    """
    where = f"{each.id}.task"
    if not each.task:
        raise ContentError(FILE, where, "this erratum has no task")
    data = dict(each.task)
    if "printed" in data:
        data["wrong"] = [{"answer": data.pop("printed"), "says": SO_PRINTED}, *data.get("wrong", [])]
    table = Table(FILE, data, where)
    rows = table.value("rows", [])
    in_rows = bool(rows)
    parts = rows or [list(table.texts("parts"))]
    if not all(isinstance(row, list) and all(isinstance(part, str) for part in row) for row in parts):
        raise table.fail("rows", f"expected rows of texts, got {shown(parts)}")
    html = tuple(tuple(_part(part, f"{where}.parts") for part in row) for row in parts)
    given = table.value("at")
    at = frozenset(tuple(place) if isinstance(place, list) else (place,) for place in given)
    task = Task(each.id, html, in_rows, at, read_question(table, lambda text, key: to_html(text, FILE, key)))
    if not at or not at <= set(task.places):
        raise table.fail("at", f"expected some of the parts {', '.join(map(str, task.places))}, got {shown(given)}")
    return task


def _part(text: str, key: str) -> str:
    """Return a part as HTML, without the paragraph around it: it stands in a line with others."""
    return to_html(text, FILE, key).strip().removeprefix("<p>").removesuffix("</p>")


@cache
def task_of(key: str) -> Task:
    """Return the task of an erratum, read once."""
    return read_task(erratum(key))


@cache
def with_tasks() -> tuple[str, ...]:
    """Return the ids of the errata that have a task, in the order of the notes."""
    return tuple(each.id for each in errata().values() if each.task)
