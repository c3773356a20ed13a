"""The right answer to a question, as it is read on its page: that of a prediction, which cannot be corrected."""

from __future__ import annotations

from collections.abc import Iterable

from armlab.content.arithmetic import shortest
from armlab.content.question import Choices, Question
from armlab.content.questions.matrix import MatrixQuestion
from armlab.content.questions.number import NumberQuestion
from armlab.ui.asking import UNIT_SIGNS
from armlab.ui.erratum_links import without_links
from armlab.ui.html import Inside, Markup, tag

FINE = 0.1
"""Largest error by which a right number is rounded, in tolerances of its question."""


def right_answer(question: Question) -> Markup:
    """Return the right answer: the text of its options, a number with its unit, a formula, or the rows of a matrix."""
    return tag("div.right-answer", tag("p", "The right answer:"), _read(question))


def _read(question: Question) -> Inside:
    form, answer = question.form, question.right_answer
    if isinstance(form, Choices):
        chosen = [tag("div", without_links(form.options[int(k) - 1])) for k in answer.split(",")]
        return chosen if len(chosen) == 1 else tag("ul", [tag("li", each) for each in chosen])
    if isinstance(question, NumberQuestion):
        return _line((question.answer,), question.tolerance, question.unit)
    if isinstance(question, MatrixQuestion):
        return [_line(row, question.tolerance, question.unit) for row in question.answer]
    return tag("p", tag("code", answer))


def _line(numbers: Iterable[float], tolerance: float, unit: str) -> Markup:
    """Return numbers with their unit, no finer than the question takes them."""
    said = [rounded(float(number), FINE * tolerance).replace("-", "\N{MINUS SIGN}") for number in numbers]
    return tag("p", "  ".join(said), f" {UNIT_SIGNS.get(unit, unit)}" if unit else None)


def rounded(value: float, error: float) -> str:
    """Return a number with as few digits as keep it within an error.

    >>> rounded(0.8660254, 0.001), rounded(120.0, 0.05), rounded(1e-9, 0.0)
    ('0.866', '120', '1e-09')
    """
    texts = (f"{value:.{digits}g}" for digits in range(1, 17))
    return next((shortest(float(text)) for text in texts if abs(float(text) - value) <= error), shortest(value))
