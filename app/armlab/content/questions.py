"""Questions of lessons whose answer is a number with a unit; mistakes are named where they can be."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from html import escape

from armlab.content.arithmetic import evaluate, plain_symbols
from armlab.content.reader import Table
from armlab.errors import InputError

UNITS: dict[str, tuple[str, float]] = {
    "": ("a pure number", 1.0),
    "m": ("a length", 1.0),
    "cm": ("a length", 1e-2),
    "mm": ("a length", 1e-3),
    "rad": ("an angle", 1.0),
    "deg": ("an angle", math.pi / 180.0),
    "s": ("a time", 1.0),
    "ms": ("a time", 1e-3),
    "m/s": ("a speed", 1.0),
    "cm/s": ("a speed", 1e-2),
    "mm/s": ("a speed", 1e-3),
    "rad/s": ("an angular speed", 1.0),
    "deg/s": ("an angular speed", math.pi / 180.0),
    "m^2": ("an area", 1.0),
    "cm^2": ("an area", 1e-4),
    "mm^2": ("an area", 1e-6),
    "N": ("a force", 1.0),
    "Nm": ("a torque", 1.0),
}
"""Unit to the kind of quantity and its size in the unit the lab calculates with."""

_SPELLINGS = {"°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "m2": "m^2"}
_UNIT = re.compile(r"(?<![a-zA-Z^/])(degrees?|deg|°|radians?|rad|cm|mm|ms|m|s|Nm|N)(\s*\^?2|\s*/\s*s)?$")
ROUNDING = 1e-9
"""What a tolerance is widened by, as a part of it: a number exactly at its edge is right."""


@dataclass(frozen=True)
class Verdict:
    """Whether an answer is right, and what there is to say about it, as HTML."""

    right: bool
    says: str


@dataclass(frozen=True)
class Wrong:
    """A wrong answer a lesson expects, in the question's unit, and what it says to it (HTML)."""

    answer: float
    says: str


@dataclass(frozen=True)
class Question:
    """A question.

    Attributes
    ----------
    html : str
        What is asked.
    answer, tolerance : float
        In ``unit``.
    unit : str
        One of `UNITS`; a number without a unit is taken in it.
    wrong : tuple of Wrong
    """

    html: str
    answer: float
    unit: str
    tolerance: float
    wrong: tuple[Wrong, ...] = ()

    def judge(self, text: str) -> Verdict:
        """Return the verdict on an answer as typed, such as ``0.5``, ``0,5``, ``50 cm``, ``pi/2`` or ``90°``."""
        try:
            value, unit = read_quantity(text)
        except InputError as error:
            return Verdict(False, escape(str(error), quote=False))
        quantity, own = UNITS[self.unit]
        if unit is not None:
            got, size = UNITS[unit]
            if got != quantity:
                return Verdict(False, f"This is {got}; the question asks for {quantity}{self._written_unit()}.")
            value *= size / own
        if self._near(value, self.answer):
            return Verdict(True, "Right.")
        for wrong in self.wrong:
            if self._near(value, wrong.answer):
                return Verdict(False, wrong.says)
        return Verdict(False, self._mistake(value, unit is None) or "This is not the answer yet.")

    def _near(self, value: float, answer: float) -> bool:
        return abs(value - answer) <= self.tolerance * (1.0 + ROUNDING)

    def _mistake(self, value: float, unit_left_out: bool) -> str:
        """Return the name of a common mistake, or nothing."""
        quantity, own = UNITS[self.unit]
        if self._near(-value, self.answer):
            return "The size is right, the sign is not."
        if unit_left_out:
            for unit, (other, size) in UNITS.items():
                if other == quantity and unit != self.unit and self._near(value * size / own, self.answer):
                    return f"The number is right in {unit}; write its unit, or give it in {self.unit}."
        turn = 2.0 * math.pi / own
        if quantity == "an angle" and self._near(math.remainder(value - self.answer, turn), 0.0):
            return "The direction is right, but it is a whole turn away."
        return ""

    def _written_unit(self) -> str:
        return f" in {self.unit}" if self.unit else ""


def read_quantity(text: str) -> tuple[float, str | None]:
    """Return the number and the unit, None when there is none, of an answer as typed.

    Raises
    ------
    InputError
        It cannot be read.

    Examples
    --------
    >>> read_quantity("50 cm"), read_quantity("0,5"), read_quantity("90°")
    ((50.0, 'cm'), (0.5, None), (90.0, 'deg'))
    """
    source = plain_symbols(text.replace("²", "^2")).strip()
    found = _UNIT.search(source)
    unit = None
    if found:
        name = _SPELLINGS.get(found[1], found[1])
        unit = name + re.sub(r"\s*\^?2", "^2", found[2] or "").replace(" ", "")
        source = source[: found.start()].strip()
        if unit not in UNITS:
            raise InputError(f"The unit {unit} is not known; there are {', '.join(filter(None, UNITS))}.")
    if source.count(",") == 1 and "." not in source:
        source = re.sub(r"(?<=\d),(?=\d)", ".", source)
    try:
        return evaluate(source), unit
    except InputError:
        cut = text if len(text) <= 40 else text[:37] + "..."
        raise InputError(f"I cannot read {cut!r}: write a number such as 0.5, 50 cm, pi/2 or 90 deg.") from None


def read_question(table: Table, to_html: Callable[[str, str], str]) -> Question:
    """Read the table of a question.

    Parameters
    ----------
    table : Table
        ``kind = "number"``, ``text``, ``answer``, ``unit`` (none: a pure number), ``tolerance`` and tables ``wrong``
        with ``answer`` and ``says``.
    to_html : callable
        Makes HTML of Markdown; the second argument is its key in the file.

    Raises
    ------
    ContentError
    """
    table.choice("kind", ("number",))
    unit = table.choice("unit", UNITS, "") if table.has("unit") else ""
    answer, tolerance = table.number("answer"), table.number("tolerance")
    if tolerance <= 0:
        raise table.fail("tolerance", f"expected a positive number, got {tolerance:g}")
    wrong = []
    for entry in table.tables("wrong"):
        said = Wrong(entry.number("answer"), to_html(entry.text("says"), f"{entry.where}.says"))
        if abs(said.answer - answer) <= 2.0 * tolerance:
            raise entry.fail("answer", f"{said.answer:g} is too close to the right answer {answer:g}")
        entry.done()
        wrong.append(said)
    html = to_html(table.text("text"), f"{table.where}.text")
    table.done()
    return Question(html, answer, unit, tolerance, tuple(wrong))
