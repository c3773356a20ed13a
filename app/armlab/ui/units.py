"""Units and names chosen by the student, used by all code that shows or reads a quantity."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from dataclasses import dataclass

from armlab.content.arithmetic import evaluate
from armlab.content.table_cells import quarter_turn, rounding_of
from armlab.errors import InputError
from armlab.kin.dh import Convention
from armlab.kin.field import ROUNDING
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.format import number, readable, subscript, trimmed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.remarks import remark

LARGEST_RADIANS = 4.0 * math.pi
"""Largest angle, radians, that is typed without a unit and without a remark: a larger one is probably in degrees."""

RELATIVE = 1e-4
"""Largest part of a bound that counts as its rounding."""


@dataclass(frozen=True)
class Book:
    """How a book names the columns of the table.

    Attributes
    ----------
    title : str
    order : tuple of str
        Fields of a row, in the order of the columns.
    symbols : dict
        Field to its letter.
    index : str
        The letter that counts joints.
    """

    title: str
    order: tuple[str, str, str, str]
    symbols: dict[str, str]
    index: str = "i"


_LETTERS = {"a": "a", "alpha": "α", "d": "d", "theta": "θ"}
_LATEX = {"α": r"\alpha", "θ": r"\theta", "ϑ": r"\vartheta"}

BOOKS: dict[str, Book] = {
    "notes": Book("Course notes", ("a", "alpha", "d", "theta"), _LETTERS),
    "craig": Book("Craig", ("alpha", "a", "d", "theta"), _LETTERS),
    "siciliano": Book("Siciliano", ("a", "alpha", "d", "theta"), {**_LETTERS, "theta": "ϑ"}),
    "corke": Book("Corke", ("theta", "d", "a", "alpha"), _LETTERS, "j"),
}

Range = tuple[float, float]

NAMES = {"a": "link length", "alpha": "link twist", "d": "link offset", "theta": "joint angle"}
"""Names of the fields in words, the same in all of these books."""


@dataclass(frozen=True)
class Units:
    """Units and names of one student."""

    notation: Notation

    @property
    def book(self) -> Book:
        """The book whose names the table has."""
        return BOOKS[self.notation.book]

    @property
    def in_degrees(self) -> bool:
        """Whether angles are in degrees."""
        return self.notation.angle == "deg"

    @property
    def angle_unit(self) -> str:
        """The unit of angles."""
        return "°" if self.in_degrees else "rad"

    @property
    def length_unit(self) -> str:
        """The unit of lengths."""
        return self.notation.length

    def unit(self, revolute: bool) -> str:
        """Return the unit of a joint variable."""
        return self.angle_unit if revolute else self.length_unit

    @property
    def turn_in_latex(self) -> str:
        """A whole turn in formulas."""
        return r"360\text{°}" if self.in_degrees else r"2\pi"

    def turned_by(self, quarters: int) -> str:
        """Return some quarters of a turn as a text.

        >>> Units(Notation()).turned_by(1), [Units(Notation(angle="rad")).turned_by(k) for k in (1, 2, 3, 4)]
        ('90°', ['π/2', 'π', '3π/2', '2π'])
        """
        if self.in_degrees:
            return f"{90 * quarters}°"
        halves, odd = divmod(quarters, 2)
        times = quarters if odd else halves
        return f"{times if times != 1 else ''}π{'/2' if odd else ''}"

    def factor(self, revolute: bool) -> float:
        """Return the factor from a joint variable on screen to radians or metres."""
        if revolute:
            return math.pi / 180.0 if self.in_degrees else 1.0
        return 1e-3 if self.notation.length == "mm" else 1.0

    def decimals(self, revolute: bool) -> int:
        """Return the number of decimals that a student needs: 0.1° or 0.001 rad, 0.1 mm or 0.0001 m."""
        if revolute:
            return 1 if self.in_degrees else 3
        return 1 if self.notation.length == "mm" else 4

    def value(self, value: float, revolute: bool) -> float:
        """Return a joint variable as the number on a slider."""
        return round(value / self.factor(revolute), self.decimals(revolute)) + 0.0

    def text(self, value: float, revolute: bool) -> str:
        """Return an angle in radians or a length in metres as a number on screen, without its unit."""
        return number(value / self.factor(revolute), self.decimals(revolute))

    def angle(self, value: float) -> str:
        """Return an angle with its unit."""
        return f"{self.text(value, True)}{self._ending(True)}"

    def turned(self, value: float) -> str:
        """Return an angle without its unit, in (−180°, 180°]: a number that rounds to −180° becomes 180°.

        For orientations. A joint that stands at −180° does not stand at 180°: see `angle`.
        """
        text = self.text(math.remainder(value, 2.0 * math.pi), True)
        return self.text(math.pi, True) if text == self.text(-math.pi, True) else text

    def orientation(self, value: float) -> str:
        """Return an angle modulo whole turns, in (−180°, 180°] and with its unit."""
        return f"{self.turned(value)}{self._ending(True)}"

    def length(self, value: float) -> str:
        """Return a length with its unit."""
        return f"{self.text(value, False)}{self._ending(False)}"

    def entry(self, value: float, revolute: bool, more: int = 1) -> str:
        """Return a number of the table without its unit, with ``more`` extra decimals, and without zeros at its end."""
        return trimmed(value / self.factor(revolute), self.decimals(revolute) + more)

    def constant(self, value: float, revolute: bool, more: int = 1) -> str:
        """Return a number of the table with its unit, equal to that in its cell."""
        return f"{self.entry(value, revolute, more)}{self._ending(revolute)}"

    def _ending(self, revolute: bool) -> str:
        """Return the unit in the form that follows a number."""
        return "°" if revolute and self.in_degrees else f" {self.unit(revolute)}"

    def said(self, text: str) -> str:
        """Return a text of somebody's, written with degrees, with its angles in the unit on screen.

        >>> Units(Notation(angle="rad")).said("200 counts of 0.36° in 0.1 s are 720 °/s")
        '200 counts of 0.00628 rad in 0.1 s are 12.6 rad/s'
        """
        return text if self.in_degrees else _DEGREES.sub(lambda at: f"{math.radians(float(at[1])):.3g} rad", text)

    def symbol(self, field: str, index: int) -> str:
        """Return the symbol of a field of the table, such as θ₁."""
        return subscript(self.book.symbols[field], index)

    def latex(self, field: str) -> str:
        """Return the letter of a field of the table in LaTeX."""
        return _LATEX.get(self.book.symbols[field], field)

    def variable(self, i: int, revolute: bool) -> str:
        """Return the symbol of joint variable i (0-based): q₁, or θ₁ and d₁ as in the table."""
        if self.notation.variable == "q":
            return subscript("q", i + 1)
        return self.symbol("theta" if revolute else "d", i + 1)

    def column(self, field: str, convention: Convention) -> Markup:
        """Return the head of a column of the table, with its unit."""
        before = convention == "modified" and field in ("a", "alpha")
        index = f"{self.book.index}−1" if before else self.book.index
        unit = self.angle_unit if field in ("alpha", "theta") else self.length_unit
        return joined(self.book.symbols[field], tag("sub", index), f", {unit}")

    def read(
        self,
        text: str,
        revolute: bool,
        where: str,
        per: str = "",
        within: Range | None = None,
        why: str = "",
    ) -> float:
        """Return radians or metres from a typed text: a number in the unit on screen, or with π or a unit.

        An angle in radians that is the rounding of quarter turns, and whose field shows these, is these: 3.1416 is π.
        Axes are parallel or not, and half a turn has no other sense.

        Parameters
        ----------
        text : str
        revolute : bool
        where : str
            For the sentence of the error.
        per : str
            What follows the unit of a rate: ``"/s"``, ``"/s²"``; it may be typed or left out.
        within : (float, float), optional
            Least and largest value, radians or metres. An angle that passes one by no more than its rounding in a field
            is that one: 3.1416 rad is as far as π.
        why : str
            End of the sentence of the error for a value beyond these.

        Raises
        ------
        InputError
            Not a number, or out of range; the range is given in the unit on screen.

        Examples
        --------
        >>> units = Units(Notation())
        >>> units.read("90", True, "angle") == units.read("pi/2", True, "angle")
        True
        >>> units.read("2 m", False, "length"), units.read("250", False, "length")
        (2.0, 0.25)
        """
        plain = text.strip().lower().replace("−", "-").replace("π", "pi").replace(",", ".")
        plain = plain.removesuffix(per).rstrip()
        factor, bare = self.factor(revolute), False
        endings = ANGLES if revolute else _LENGTHS
        for ending, known in endings.items():
            if plain.endswith(ending):
                plain, factor = plain[: -len(ending)].rstrip(), known
                break
        else:
            factor = 1.0 if revolute and "pi" in plain else factor
            bare = revolute and not self.in_degrees and not per and "pi" not in plain
        unit = ("degrees" if revolute and self.in_degrees and not per else self.unit(revolute)) + per
        try:
            value = factor * evaluate(plain)
        except InputError:
            raise InputError(f"{where}: expected a number in {unit}, got {text.strip()[:40]!r}") from None
        if revolute and factor == 1.0 and not per:
            value = quarter_turn(value, rounding_of(plain), self._half_a_digit)
        if bare:
            remark_on_radians(value)
        low, high = (-math.inf, math.inf) if within is None else within
        if not low - self._rounding(low, revolute) <= value <= high + self._rounding(high, revolute):
            least, most = (readable(bound / self.factor(revolute), 4) for bound in (low, high))
            got = f"got {text.strip()[:40]!r}{why}"
            raise InputError(f"{where}: expected a number in {unit} from {least} to {most}, {got}")
        return min(max(value, low), high)

    def _rounding(self, bound: float, revolute: bool) -> float:
        """Return how far from a bound, radians or metres, that field may be which shows the bound."""
        return max(ROUNDING, min(self._half_a_digit, RELATIVE * abs(bound))) if revolute else ROUNDING

    @property
    def _half_a_digit(self) -> float:
        """Half of the last digit of an angle in a field, radians."""
        return 0.5 * 10.0 ** -(self.decimals(True) + 1) * self.factor(True)


_DEGREES = re.compile(r"(\d+(?:\.\d+)?) ?°")
ANGLES = {"deg": math.pi / 180.0, "°": math.pi / 180.0, "rad": 1.0}
"""Sizes, in radians, of the units of angles that can be typed."""

_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}


def remark_on_radians(value: float) -> None:
    """Remark on an angle that was typed without a unit, if in radians it is more than two turns."""
    if abs(value) > LARGEST_RADIANS:
        typed = trimmed(value, 4)
        remark(f"Read as {typed} rad. For degrees type {typed}° or {typed} deg.")


def units_of(state: State) -> Units:
    """Return the units of a student."""
    return Units(state[Notation])


def plain_number(text: str, where: str = "", expected: str = "a number") -> float:
    """Return a typed number without a unit, or a formula of numbers such as ``sqrt(2)/2``.

    Parameters
    ----------
    text : str
    where, expected : str
        For the sentence of the `InputError` when it is none.
    """
    try:
        return evaluate(text.strip().lower().replace("−", "-").replace("π", "pi").replace(",", "."))
    except InputError:
        said = f"{where}: " if where else ""
        raise InputError(f"{said}expected {expected}, got {text.strip()[:40]!r}") from None


def typed_numbers(text: str, where: str, count: int, of: str) -> list[float]:
    """Return one typed number, or ``count`` of them if all were pasted, with or without brackets.

    Parameters
    ----------
    text, where : str
    count : int
    of : str
        What they are the numbers of, for the `InputError` when it is none of both.
    """
    parts = re.sub(r"[\[\]{};]|,\s", " ", text).split()
    if len(parts) == count:
        with suppress(InputError):
            return [plain_number(part) for part in parts]
    return [plain_number(text, where, f"a number, or all {count} of {of}")]
