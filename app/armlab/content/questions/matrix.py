"""Questions for a matrix; common mistakes are named without revealing the entries."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray

from armlab.content.arithmetic import shortest
from armlab.content.quantities import ROUNDING, UNITS
from armlab.content.question import NOT_YET, RIGHT, Asked, Grid, QuestionType, ToHtml, Verdict, Wrong, says, unreadable
from armlab.content.questions._matrix_text import read_matrix
from armlab.content.reader import Table
from armlab.errors import InputError

Matrix = NDArray[np.float64]

MOST_ROWS, MOST_COLUMNS = 6, 12
DUST = 1e-12
"""Part of the largest entry below which an entry is what rounding left of zero."""

MOST_PERMUTED = 4
"""Largest number of rows or columns for which every order is tried, beyond exchanging two."""


@dataclass(frozen=True, eq=False)
class WrongMatrix:
    """A wrong matrix that a lesson expects, of any shape, and the lesson's text on it (HTML)."""

    answer: Matrix
    says: str


@dataclass(frozen=True, eq=False)
class MatrixQuestion:
    """A question for a matrix; ``answer`` and ``tolerance``, the same for every entry, are in ``unit``."""

    html: str
    answer: Matrix
    tolerance: float
    unit: str = ""
    mistakes: tuple[WrongMatrix, ...] = ()
    hide: tuple[str, ...] = ()

    @property
    def form(self) -> Grid:
        """The form of the answer: rows and columns."""
        rows, columns = self.answer.shape
        return Grid(rows, columns, self.unit)

    @property
    def right_answer(self) -> str:
        """The right matrix, such as ``1 0; 0 1``."""
        return typed(self.answer)

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers that the lesson names."""
        return tuple(Wrong(typed(wrong.answer), wrong.says) for wrong in self.mistakes)

    def judge(self, text: str) -> Verdict:
        """Return the verdict on a matrix as typed; a vector may be a row or a column."""
        try:
            got = read_matrix(text, (self.answer.shape[0], self.answer.shape[1]), self.unit)
        except InputError as error:
            return unreadable(error)
        if 1 in self.answer.shape and got.shape == self.answer.T.shape:
            got = got.T
        if self._same(got, self.answer):
            return RIGHT
        for i, wrong in enumerate(self.mistakes, start=1):
            if self._same(got, wrong.answer):
                return Verdict(False, wrong.says, f"wrong[{i}]")
        if got.shape != self.answer.shape and not self._same(got, self.answer.T):
            rows, columns = self.answer.shape
            says = f"This has {_size(*got.shape)}; the question asks for {_size(rows, columns)}."
            return Verdict(False, says, "shape")
        return next(self._mistakes(got), Verdict(False, NOT_YET))

    def _same(self, got: Matrix, answer: Matrix) -> bool:
        return got.shape == answer.shape and not self._off(got, answer).any()

    def _off(self, got: Matrix, answer: Matrix) -> NDArray[np.bool_]:
        """Return a mask of the wrong entries."""
        return np.asarray(~(np.abs(got - answer) <= self.tolerance * (1.0 + ROUNDING)))

    def _mistakes(self, got: Matrix) -> Iterator[Verdict]:
        """Yield the common mistakes, the likelier first; the last one applies always."""
        answer = self.answer
        if self._same(got, answer.T):
            yield Verdict(False, "This is the transposed matrix: rows and columns are exchanged.", "transposed")
        if self._same(-got, answer):
            yield Verdict(False, "The sizes are right; all signs are the other way round.", "sign")
        quantity, own = UNITS[self.unit]
        for other, (kind, size) in UNITS.items():
            if kind == quantity and other != self.unit and self._same(got * size / own, answer):
                yield Verdict(False, f"The numbers are right in {other}; give them in {self.unit}.", "unit")
        for what, axis in (("rows", 0), ("columns", 1)):
            yield from self._exchanged(got, what, axis)
        yield self._entries(got)

    def _exchanged(self, got: Matrix, what: str, axis: int) -> Iterator[Verdict]:
        count = self.answer.shape[axis]
        for i, k in combinations(range(count), 2):
            order = list(range(count))
            order[i], order[k] = k, i
            if self._same(np.take(got, order, axis), self.answer):
                yield Verdict(False, f"The {what} {i + 1} and {k + 1} are exchanged.", f"{what} exchanged")
        if count <= MOST_PERMUTED:
            orders = (list(order) for order in permutations(range(count)))
            if any(self._same(np.take(got, order, axis), self.answer) for order in orders):
                yield Verdict(False, f"The {what} are right, but not in this order.", f"{what} exchanged")

    def _entries(self, got: Matrix) -> Verdict:
        """Return the verdict with the first wrong entry."""
        off = self._off(got, self.answer)
        i, k = np.argwhere(off)[0]
        place, count = f"row {i + 1}, column {k + 1}", int(off.sum())
        if not self._off(-got, self.answer)[off].any():
            if count == 1:
                return Verdict(False, f"One sign is wrong: {place}.", "sign")
            return Verdict(False, f"{count} signs are wrong; the first is in {place}.", "sign")
        if count == 1:
            return Verdict(False, f"All entries are right but one: {place}.", "entry")
        return Verdict(False, f"{count} of {off.size} entries are not right; the first is in {place}.", "entries")


def typed(matrix: Matrix) -> str:
    """Return a matrix as a person would type it, without the rounding errors of computed entries.

    >>> typed(np.array([[1.0, 0.5], [-2.0, 0.3 - 0.1]])), typed(np.array([[2.0, 6e-17]]))
    ('1 0.5; -2 0.2', '2 0')
    """
    least = DUST * float(np.abs(matrix).max())
    cleaned = np.where(np.abs(matrix) < least, 0.0, matrix)
    return "; ".join(" ".join(shortest(float(f"{entry:.12g}")) for entry in row) for row in cleaned)


def _size(rows: int, columns: int) -> str:
    return f"{rows} row{'s' * (rows > 1)} and {columns} column{'s' * (columns > 1)}"


def read(table: Table, asked: Asked, to_html: ToHtml) -> MatrixQuestion:
    """Read ``answer`` (rows), ``tolerance``, ``unit`` (default none) and ``wrong`` with ``answer`` and ``says``."""
    unit = table.choice("unit", UNITS, "") if table.has("unit") else ""
    answer, tolerance = _matrix(table), table.number("tolerance")
    if tolerance <= 0:
        raise table.fail("tolerance", f"expected a positive number, got {tolerance:g}")
    wrong = []
    for entry in table.tables("wrong"):
        matrix = _matrix(entry)
        near = matrix.shape == answer.shape and bool(np.all(np.abs(matrix - answer) <= 2.0 * tolerance))
        asked.check_apart(entry, near, "too close to the right answer")
        wrong.append(WrongMatrix(matrix, says(entry, to_html)))
        entry.done()
    return MatrixQuestion(asked.html, answer, tolerance, unit, tuple(wrong), asked.hide)


def _matrix(table: Table) -> Matrix:
    matrix = table.rows("answer")
    rows, columns = matrix.shape
    if rows > MOST_ROWS or columns > MOST_COLUMNS:
        raise table.fail("answer", f"expected at most {_size(MOST_ROWS, MOST_COLUMNS)}, got {_size(rows, columns)}")
    matrix.setflags(write=False)
    return matrix


QUESTION = QuestionType("matrix", 30, read)
