"""Questions for a formula of matrices: an answer is right when it has the same values for seeded matrices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeGuard

import numpy as np

from armlab.content.expressions import RESERVED, Expression, parse
from armlab.content.question import NOT_YET, RIGHT, Asked, Field, QuestionType, ToHtml, Verdict, Wrong, says, unreadable
from armlab.content.questions._matrix_algebra import Algebra, Value, shape_of
from armlab.content.questions.expression import NAME
from armlab.content.reader import Table, shown
from armlab.errors import InputError

POINTS = 20
"""Number of seeded sets of matrices at which two formulas are compared."""

RELATIVE = 1e-6
"""Largest difference of equal formulas, in parts of the largest entry."""

MOST_NAMES, MOST_ROWS = 8, 6

Shape = tuple[int, ...]


@dataclass(frozen=True)
class WrongMatrixFormula:
    """A wrong formula that is expected, and the text on it (HTML)."""

    answer: Expression
    says: str


@dataclass(frozen=True)
class MatrixFormulaQuestion:
    """A question.

    Attributes
    ----------
    html : str
    answer : Expression
    names : mapping of str to tuple of int
        Rows and columns of the matrices that may stand in an answer; empty of a number.
    identities : mapping of str to int
        Names of identity matrices, and their sizes.
    also : tuple of Expression
        Other right answers with other values, such as with the opposite sign of a multiplier.
    mistakes : tuple of WrongMatrixFormula
    hide : tuple of str
    """

    html: str
    answer: Expression
    names: Mapping[str, Shape]
    identities: Mapping[str, int]
    also: tuple[Expression, ...] = ()
    mistakes: tuple[WrongMatrixFormula, ...] = ()
    hide: tuple[str, ...] = ()

    @property
    def form(self) -> Field:
        """The form of the answer: one line."""
        return Field()

    @property
    def right_answer(self) -> str:
        """The formula as written in the file."""
        return self.answer.text

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers that are named."""
        return tuple(Wrong(wrong.answer.text, wrong.says) for wrong in self.mistakes)

    def judge(self, text: str) -> Verdict:
        """Return the verdict on a formula as typed, such as ``J^T (J J^T)^-1``."""
        try:
            got = self._values(self.read(text))
        except InputError as error:
            return unreadable(error)
        if any(_equal(got, right) for right in self._right):
            return RIGHT
        for i, wrong in enumerate(self.mistakes, start=1):
            if _equal(got, self._values(wrong.answer)):
                return Verdict(False, wrong.says, f"wrong[{i}]")
        return next(self._mistakes(got), Verdict(False, NOT_YET))

    def read(self, text: str) -> Expression:
        """Read a formula of these names; ``^T`` transposes. `InputError` for anything else."""
        return parse(text.replace("ᵀ", "^T"), [*self.names, *self.identities, "T"], ("sqrt",))

    def value(self, formula: Expression, number: int) -> Value:
        """Return the value of a formula for one of the seeded sets; `InputError` if sizes do not fit, or no inverse."""
        return self._sets[number].value(formula)

    @cached_property
    def _sets(self) -> tuple[Algebra, ...]:
        rng = np.random.default_rng(4)
        fixed = {name: np.eye(size) for name, size in self.identities.items()}
        return tuple(
            Algebra({name: _drawn(rng, shape) for name, shape in self.names.items()} | fixed) for _ in range(POINTS)
        )

    @cached_property
    def _right(self) -> tuple[list[Value], ...]:
        return tuple(self._values(each) for each in (self.answer, *self.also))

    def _values(self, formula: Expression) -> list[Value]:
        return [self.value(formula, k) for k in range(POINTS)]

    def same_as(self, formula: Expression) -> bool:
        """Return whether a formula is equal to the answer, or to another right one."""
        return any(_equal(self._values(formula), right) for right in self._right)

    def _mistakes(self, got: list[Value]) -> Iterator[Verdict]:
        right = self._right[0]
        if shape_of(got[0]) != shape_of(right[0]):
            transposed = _equal([np.transpose(each) for each in got], right)
            if transposed:
                yield Verdict(False, "This is the transposed matrix.", "transposed")
            yield Verdict(False, f"This is {size(got[0])}; the answer is {size(right[0])}.", "shape")
        if _equal([-each for each in got], right):
            yield Verdict(False, "All signs are the other way round.", "sign")
        if _equal([np.transpose(each) for each in got], right):
            yield Verdict(False, "This is the transposed matrix.", "transposed")


def size(value: Value) -> str:
    """Return what a value is in words: ``a 2 × 3 matrix`` or ``a number``."""
    shape = shape_of(value)
    return f"a {shape[0]} × {shape[1]} matrix" if shape else "a number"


def _drawn(rng: np.random.Generator, shape: Shape) -> Value:
    """Return a well-conditioned matrix, or a positive number."""
    if not shape:
        return float(rng.uniform(0.3, 2.0))
    U, _, Vt = np.linalg.svd(rng.normal(size=shape), full_matrices=False)
    return np.asarray(U * rng.uniform(0.5, 2.0, min(shape)) @ Vt)


def _equal(got: Sequence[Value], right: Sequence[Value]) -> bool:
    def one(a: Value, b: Value) -> bool:
        if shape_of(a) != shape_of(b):
            return False
        largest = float(np.abs(b).max())
        return bool(np.all(np.abs(np.subtract(a, b)) <= RELATIVE * max(largest, RELATIVE)))

    return all(one(a, b) for a, b in zip(got, right, strict=True))


def read(table: Table, asked: Asked, to_html: ToHtml) -> MatrixFormulaQuestion:
    """Read ``names``, ``identities``, ``answer``, ``also`` and tables ``wrong`` with ``answer`` and ``says``."""
    names = {name: _shape(table, name, value) for name, value in _mapping(table, "names").items()}
    identities = {name: _size(table, name, value) for name, value in _mapping(table, "identities", {}).items()}
    if not 1 <= len(names) <= MOST_NAMES or names.keys() & identities.keys():
        raise table.fail("names", f"expected 1 to {MOST_NAMES} names, each of them once, got {', '.join(names)}")
    bare = MatrixFormulaQuestion(asked.html, parse("0"), names, identities, hide=asked.hide)
    question = replace(
        bare,
        answer=_formula(bare, table, "answer", table.text("answer")),
        also=tuple(_formula(bare, table, "also", text) for text in table.texts("also")),
    )
    wrong = []
    for entry in table.tables("wrong"):
        formula = _formula(question, entry, "answer", entry.text("answer"))
        if question.same_as(formula):
            raise entry.fail("answer", "equal to the right answer")
        wrong.append(WrongMatrixFormula(formula, says(entry, to_html)))
        entry.done()
    return replace(question, mistakes=tuple(wrong))


def _formula(question: MatrixFormulaQuestion, table: Table, key: str, text: str) -> Expression:
    try:
        formula = question.read(text)
        question.value(formula, 0)
    except InputError as error:
        raise table.fail(key, str(error)) from None
    return replace(formula, text=text)


def _mapping(table: Table, key: str, default: object = None) -> Mapping[str, object]:
    value = table.value(key, default)
    if not isinstance(value, dict) or not all(NAME.match(name) and name not in RESERVED for name in value):
        raise table.fail(key, f"expected names of letters and digits such as J, each with its size, got {shown(value)}")
    return value


def _shape(table: Table, name: str, value: object) -> Shape:
    if isinstance(value, list) and len(value) in (0, 2) and all(_is_size(each) for each in value):
        return tuple(map(int, value))
    raise table.fail(
        f"names.{name}", f"expected rows and columns such as [2, 3], or [] for a number, got {shown(value)}"
    )


def _size(table: Table, name: str, value: object) -> int:
    if not _is_size(value):
        raise table.fail(f"identities.{name}", f"expected a size from 1 to {MOST_ROWS}, got {shown(value)}")
    return int(value)


def _is_size(value: object) -> TypeGuard[float]:
    return type(value) in (int, float) and value in range(1, MOST_ROWS + 1)


QUESTION = QuestionType("matrix_formula", 45, read)
