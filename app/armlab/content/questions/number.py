"""Questions for a number with a unit; common mistakes are named."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from armlab.content.arithmetic import shortest
from armlab.content.expressions import IN_DEGREES, Expression
from armlab.content.quantities import UNITS, is_near, read_formula
from armlab.content.question import (
    NOT_YET,
    OTHER_QUANTITY,
    RIGHT,
    Asked,
    Field,
    QuestionType,
    ToHtml,
    Verdict,
    Wrong,
    says,
    unreadable,
)
from armlab.content.reader import Table
from armlab.errors import InputError

PLAIN_FACTOR = 4.0
"""Distance of an answer from zero, in tolerances, from which its double and half can be distinguished from it."""


MOST_TURNS = 10
"""Turns up to which an answer may have been counted on; of more the remainder is chance, and of huge ones rounding."""


@dataclass(frozen=True)
class WrongNumber:
    """A wrong number that a lesson expects, in the question's unit, and the lesson's text on it (HTML)."""

    answer: float
    says: str


@dataclass(frozen=True)
class NumberQuestion:
    """A question.

    Attributes
    ----------
    html : str
    answer : float
        The right number, in ``unit``.
    unit : str
        One of `UNITS`; a number without a unit is taken in it.
    tolerance : float
        Tolerance in ``unit``.
    mistakes : tuple of WrongNumber
    hide : tuple of str
    """

    html: str
    answer: float
    unit: str
    tolerance: float
    mistakes: tuple[WrongNumber, ...] = ()
    hide: tuple[str, ...] = ()

    @property
    def form(self) -> Field:
        """The form of the answer: one line."""
        return Field(self.unit)

    @property
    def right_answer(self) -> str:
        """The answer with its unit."""
        return f"{shortest(self.answer)} {self.unit}".strip()

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong answers that the lesson names."""
        return tuple(Wrong(f"{shortest(wrong.answer)} {self.unit}".strip(), wrong.says) for wrong in self.mistakes)

    def judge(self, text: str) -> Verdict:
        """Return the verdict on an answer as typed, such as ``0.5``, ``0,5``, ``50 cm``, ``pi/2`` or ``90°``."""
        try:
            formula, unit = read_formula(text, self.unit)
            value = formula.value({})
        except InputError as error:
            return unreadable(error)
        quantity, own = UNITS[self.unit]
        size = own
        if unit is not None:
            got, size = UNITS[unit]
            if got != quantity:
                says = f"This is {got}; the question asks for {quantity}{self._written_unit()}."
                return Verdict(False, says, OTHER_QUANTITY)
        converted = value * size / own
        if self._near(converted):
            return RIGHT
        for i, wrong in enumerate(self.mistakes, start=1):
            if is_near(converted, wrong.answer, self.tolerance):
                return Verdict(False, wrong.says, f"wrong[{i}]")
        found = self._mistakes(value, unit, converted, self._as_calculator(formula, size / own))
        return next(found, Verdict(False, NOT_YET))

    def _near(self, value: float | None) -> bool:
        return value is not None and is_near(value, self.answer, self.tolerance)

    def _mistakes(self, typed: float, unit: str | None, value: float, in_degrees: float | None) -> Iterator[Verdict]:
        """Yield the common mistakes that lead to a value in the question's unit, the likelier first."""
        quantity, own = UNITS[self.unit]
        if self._near(-value):
            yield Verdict(False, "The size is right, the sign is not.", "sign")
        if self._near(in_degrees):
            yield Verdict(
                False, "sin, cos and tan take radians here: write cos(rad(60)) or cos(60°) for 60 degrees.", "degrees"
            )
        away = value - self.answer
        turned = self.answer + math.remainder(away, math.tau / own)
        if quantity == "an angle" and abs(away) < MOST_TURNS * math.tau / own and self._near(turned):
            yield Verdict(False, "The direction is right, but it is a whole turn away.", "turn")
        # Around zero every unit, the double and the half are right as well.
        if abs(self.answer) > PLAIN_FACTOR * self.tolerance:
            yield from self._other_units(typed, unit)
            if self._near(value / 2.0):
                yield Verdict(False, "This is twice what is asked: a factor 2 is too much.", "factor 2")
            if self._near(value * 2.0):
                yield Verdict(False, "This is half of what is asked: a factor 2 is missing.", "factor 2")

    def _other_units(self, typed: float, unit: str | None) -> Iterator[Verdict]:
        quantity, own = UNITS[self.unit]
        if self.unit == "%" and unit is None and self._near(typed / own):
            yield Verdict(False, "As a fraction this is right. In percent it is a hundred times as much.", "unit")
        for other, (kind, size) in UNITS.items():
            if kind == quantity and other != (unit or self.unit) and self._near(typed * size / own):
                if unit is None:
                    says = f"The number is right in {other}; write its unit, or give it in {self.unit}."
                    yield Verdict(False, says, "degrees" if "deg" in (other, self.unit) else "unit")
                elif quantity == "an angle":
                    yield Verdict(False, f"The number is right in {other}, but you wrote {unit}.", "degrees")

    @staticmethod
    def _as_calculator(formula: Expression, factor: float) -> float | None:
        """Return the formula's value with angles in degrees, in the question's unit; None when it has none."""
        try:
            return formula.with_functions(IN_DEGREES).value({}) * factor
        except InputError:
            return None

    def _written_unit(self) -> str:
        return f" in {self.unit}" if self.unit else ""


def read(table: Table, asked: Asked, to_html: ToHtml) -> NumberQuestion:
    """Read ``answer``, ``unit`` (default none), ``tolerance`` and ``wrong`` with ``answer`` and ``says``."""
    unit = table.choice("unit", UNITS, "") if table.has("unit") else ""
    answer, tolerance = table.number("answer"), table.number("tolerance")
    if tolerance <= 0:
        raise table.fail("tolerance", f"expected a positive number, got {tolerance:g}")
    wrong = []
    for entry in table.tables("wrong"):
        said = WrongNumber(entry.number("answer"), says(entry, to_html))
        near = abs(said.answer - answer) <= 2.0 * tolerance
        asked.check_apart(entry, near, f"{said.answer:g} is too close to the right answer {answer:g}")
        entry.done()
        wrong.append(said)
    return NumberQuestion(asked.html, answer, unit, tolerance, tuple(wrong), asked.hide)


QUESTION = QuestionType("number", 10, read)
