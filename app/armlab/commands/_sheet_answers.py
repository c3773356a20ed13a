"""Right answers on the solution sheet: as a student may type them, with no more digits than are looked at."""

from __future__ import annotations

import math
import re

import numpy as np
from numpy.typing import NDArray

from armlab.content.lesson_values import written
from armlab.content.question import Choices, Question
from armlab.content.questions.matrix import MatrixQuestion
from armlab.content.questions.number import NumberQuestion
from armlab.teaching.plain_text import plain

LEAST_DIGITS, MOST_DIGITS = 4, 6
"""Significant digits of the largest number of an answer."""

DIGITS_BEYOND, LEAST_BEYOND = 2, 1
"""Decimals beyond those of the tolerance that are written, and that are written in any case."""


def right_answer(question: Question) -> str:
    """Return the right answer to a question, to be read: with its tolerance, or with the words of its option."""
    if isinstance(question, NumberQuestion):
        return _within(_rows(np.array([[question.answer]]), question.tolerance), question.tolerance, question.unit)
    if isinstance(question, MatrixQuestion):
        return _within(_rows(question.answer, question.tolerance), question.tolerance, question.unit)
    if isinstance(question.form, Choices):
        options = question.form.options
        chosen = (int(number) for number in re.findall(r"\d+", question.right_answer))
        return "; ".join(f"{number}: {plain(options[number - 1])}" for number in chosen)
    return question.right_answer


def _within(said: str, tolerance: float, unit: str) -> str:
    unit = f" {unit}" if unit else ""
    return f"{said}{unit} ± {written(float(f'{tolerance:.3g}'))}{unit}"


def _rows(numbers: NDArray[np.float64], tolerance: float) -> str:
    decimals = decimals_of(float(np.abs(numbers).max()), tolerance)
    return "; ".join(" ".join(_rounded(float(number), decimals) for number in row) for row in numbers)


def decimals_of(largest: float, tolerance: float) -> int:
    """Return with how many decimals numbers are written: as many as the tolerance needs and two, few digits in all.

    >>> decimals_of(0.346, 0.004), decimals_of(2276.84, 45.0), decimals_of(120.0, 1.0)
    (5, 1, 2)
    """
    needed = math.ceil(-math.log10(tolerance))
    before = math.floor(math.log10(largest)) + 1 if largest > 0.0 else 1
    digits = min(max(before + needed + DIGITS_BEYOND, LEAST_DIGITS), MOST_DIGITS)
    return max(digits - before, needed + LEAST_BEYOND)


def _rounded(number: float, decimals: int) -> str:
    text = np.format_float_positional(round(number, decimals) + 0.0, trim="-")
    return text.replace("-", "\u2212")
