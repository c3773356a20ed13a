"""Questions for a formula: an answer is right when it has the same values."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.content.expressions import RESERVED, Expression, parse
from armlab.content.question import NOT_YET, RIGHT, Asked, Field, QuestionType, ToHtml, Verdict, Wrong, says, unreadable
from armlab.content.reader import Table, shown
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError

POINTS = 20
"""Number of random points at which two formulas are compared."""

TRIES = 400
"""Number of random points among which those are found at which the right answer has a value."""

RELATIVE = 1e-6
"""Largest relative difference of the values of equal formulas."""

SMALLEST, LARGEST = 0.1, 2.5
"""Least and largest magnitude of the random values."""

EXCHANGED = {"sin": "cos", "cos": "sin"}

MOST_VARIABLES = 12
NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,15}\Z")
"""Pattern of the names of variables."""

_SHORT = re.compile(r"(?<![A-Za-z_])([cs])_?(\d{1,6})(?!\d)")
_THETA = re.compile(r"(?:θ|theta)_?(\d)(?!\d)")

Values = NDArray[np.float64]


@dataclass(frozen=True)
class WrongFormula:
    """A wrong formula that a lesson expects, and the lesson's text on it (HTML)."""

    answer: Expression
    says: str


@dataclass(frozen=True)
class ExpressionQuestion:
    """A question.

    Attributes
    ----------
    html : str
    answer : Expression
    variables : tuple of str
        Names allowed in an answer. With q1, q2, ... among them, ``c12`` is cos(q1+q2), ``s1`` is sin(q1) and ``θ1`` is
        q1.
    mistakes : tuple of WrongFormula
    hide : tuple of str
    """

    html: str
    answer: Expression
    variables: tuple[str, ...]
    mistakes: tuple[WrongFormula, ...] = ()
    hide: tuple[str, ...] = ()

    @property
    def form(self) -> Field:
        """The form of the answer: one line."""
        return Field()

    @property
    def right_answer(self) -> str:
        """The formula as written in the lesson."""
        return self.answer.text

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers that the lesson names."""
        return tuple(Wrong(wrong.answer.text, wrong.says) for wrong in self.mistakes)

    def judge(self, text: str) -> Verdict:
        """Return the verdict on a formula as typed, such as ``l1 c1 + l2*cos(q1+q2)``."""
        try:
            formula = read_formula(text, self.variables)
            got = self._values(formula)
            if np.isnan(got).all():
                formula.value(self._points[0])
        except InputError as error:
            return unreadable(error)
        if self._same(got):
            return RIGHT
        for i, wrong in enumerate(self.mistakes, start=1):
            if _equal(got, self._values(wrong.answer)):
                return Verdict(False, wrong.says, f"wrong[{i}]")
        return next(self._mistakes(formula, got), Verdict(False, NOT_YET))

    def same_as(self, other: Expression) -> bool:
        """Return whether a formula is equal to the answer."""
        return self._same(self._values(other))

    @cached_property
    def _points(self) -> list[dict[str, float]]:
        return points(self.answer, self.variables)

    @cached_property
    def _right(self) -> Values:
        return self._values(self.answer)

    def _values(self, formula: Expression) -> Values:
        return np.array([_value(formula, point) for point in self._points])

    def _same(self, got: Values) -> bool:
        return _equal(got, self._right)

    def _mistakes(self, formula: Expression, got: Values) -> Iterator[Verdict]:
        if self._same(-got):
            yield Verdict(False, "All signs are the other way round.", "sign")
        exchanged = self._values(formula.with_functions(EXCHANGED))
        if self._same(exchanged):
            yield Verdict(False, "Sine and cosine are exchanged.", "sine and cosine")
        if self._same(-exchanged):
            yield Verdict(False, "Sine and cosine are exchanged, and the sign is wrong.", "sine and cosine")
        missing = self.answer.names - formula.names
        if missing:
            listed = ", ".join(sorted(missing))
            yield Verdict(False, f"The answer has to depend on {listed} as well.", "missing")


def read_formula(text: str, variables: tuple[str, ...]) -> Expression:
    """Read a formula of these variables; see `ExpressionQuestion`.

    Raises
    ------
    InputError
    """
    source = plain_symbols(text)
    joints = {name[1:] for name in variables if re.fullmatch(r"q\d", name)}

    def angle(found: re.Match[str]) -> str:
        return f"q{found[1]}" if found[1] in joints and found[0] not in variables else found[0]

    def short(found: re.Match[str]) -> str:
        digits = found[2]
        if f"{found[1]}{digits}" in variables or not set(digits) <= joints or list(digits) != sorted(set(digits)):
            return found[0]
        return f"{'cos' if found[1] == 'c' else 'sin'}({'+'.join(f'q{digit}' for digit in digits)})"

    return parse(_SHORT.sub(short, _THETA.sub(angle, source)), variables)


def points(answer: Expression, variables: tuple[str, ...]) -> list[dict[str, float]]:
    """Return seeded random points at which a formula has a value; fewer than `POINTS` when it hardly has any.

    Names that begin with l are lengths and positive, so that sqrt(l1^2) is l1; others have either sign.
    """
    rng = np.random.default_rng(4)
    found: list[dict[str, float]] = []
    for _ in range(TRIES):
        sizes, signs = rng.uniform(SMALLEST, LARGEST, len(variables)), rng.choice((-1.0, 1.0), len(variables))
        point = {
            name: float(size if name.startswith("l") else size * sign)
            for name, size, sign in zip(variables, sizes, signs, strict=True)
        }
        if not np.isnan(_value(answer, point)):
            found.append(point)
        if len(found) == POINTS:
            break
    return found


def _value(formula: Expression, point: Mapping[str, float]) -> float:
    """Return the value of a formula at a point, nan when it has none."""
    try:
        return formula.value(point)
    except InputError:
        return float("nan")


def _equal(got: Values, right: Values) -> bool:
    # Where the right value is near zero its rounding is that of its terms, so the mean size counts there.
    size = np.maximum(np.abs(right), float(np.abs(right).mean()))
    return bool(np.all(np.abs(got - right) <= RELATIVE * np.maximum(size, RELATIVE)))


def read(table: Table, asked: Asked, to_html: ToHtml) -> ExpressionQuestion:
    """Read ``answer`` (a formula), ``variables`` and tables ``wrong`` with ``answer`` and ``says``."""
    variables = _variables(table)
    answer = _formula(table, variables)
    if len(points(answer, variables)) < POINTS:
        raise table.fail("answer", "expected a formula that has a value for most values of its variables")
    question = ExpressionQuestion(asked.html, answer, variables)
    wrong = []
    for entry in table.tables("wrong"):
        formula = _formula(entry, variables)
        if question.same_as(formula):
            raise entry.fail("answer", "equal to the right answer")
        wrong.append(WrongFormula(formula, says(entry, to_html)))
        entry.done()
    return ExpressionQuestion(asked.html, answer, variables, tuple(wrong), asked.hide)


def _variables(table: Table) -> tuple[str, ...]:
    names = table.value("variables")
    if not isinstance(names, list) or not 1 <= len(names) <= MOST_VARIABLES:
        raise table.fail("variables", f"expected a list of 1 to {MOST_VARIABLES} names, got {shown(names)}")
    for name in names:
        if not isinstance(name, str) or not NAME.match(name):
            raise table.fail("variables", f"expected names of letters and digits such as 'q1', got {shown(name)}")
        if name in RESERVED:
            raise table.fail("variables", f"{name!r} has a meaning of its own; choose another name")
    if len(set(names)) < len(names):
        raise table.fail("variables", "a name comes twice")
    return tuple(names)


def _formula(table: Table, variables: tuple[str, ...]) -> Expression:
    text = table.text("answer")
    try:
        formula = read_formula(text, variables)
    except InputError as error:
        raise table.fail("answer", str(error)) from None
    return replace(formula, text=text)  # as the lesson has it, not as it was spelled out


QUESTION = QuestionType("expression", 40, read)
