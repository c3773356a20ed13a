"""The terms of a formula as people type them: which say in what unit their angles are, and which leave it open."""

from __future__ import annotations

import math
import re

from armlab.content.expressions import FUNCTIONS, parse
from armlab.errors import InputError

_KEEP = ("abs", "min", "max")
"""Functions whose value is of the quantity of their arguments."""

_IN_RADIANS = ("asin", "acos", "atan", "atan2", "rad")
_OF_ANGLES = ("sin", "cos", "tan")
_NAMES = "|".join(sorted(FUNCTIONS, key=len, reverse=True))
_BRACKET = re.compile(rf"(?:(?<![a-z])(?P<name>{_NAMES})\s*)?\((?P<inside>[^()]*)\)", re.IGNORECASE)
_UNIT = re.compile(r"°|(?<![a-z])(?:deg|rad)(?![a-z])", re.IGNORECASE)
_UNIT_OF_RADIANS = re.compile(r"(?<![a-z])rad(?!\s*\()(?![a-z])", re.IGNORECASE)
_RAD_OF = re.compile(r"(?<![a-z])rad(?=\s*\()", re.IGNORECASE)
_PI = re.compile(r"(?<![a-z])pi(?![a-z])", re.IGNORECASE)


def angle_terms(source: str) -> list[str]:
    """Return the terms of a sum, with ``1``, ``pi`` or ``1°`` for each bracket: a number, radians, or with a unit.

    >>> angle_terms("pi/2 - cos(60°)"), angle_terms("2*(90° - 30°) - atan2(1, 2)")
    (['pi/2', '1'], ['2*1°', 'pi'])
    """
    while found := _BRACKET.search(source):
        source = f"{source[: found.start()]} {_stands_for(found)} {source[found.end() :]}"
    source = re.sub(r"(?<=[\d.])e[+-]?\d+", "", source, flags=re.IGNORECASE)
    source = re.sub(r"([*/^])[\s+-]+", r"\1", source)
    return [term.strip() for term in re.split(r"[+-]", re.sub(r"\A[\s+-]+", "", source))]


def units_in(term: str) -> int:
    """Return how many factors of a term have a unit of angles; with two, as in 180°/30°, it is no angle.

    >>> units_in("2*30°"), units_in("180 deg/30 deg"), units_in("pi")
    (1, 2, 0)
    """
    return len(_UNIT.findall(term))


def is_in_radians(term: str) -> bool:
    """Return whether a term is an angle in radians by itself: with pi, or with the value of an arc function."""
    return _PI.search(term) is not None


class OpenUnit(InputError):
    """A number without a unit is added to an angle with one: whether it is in degrees or in radians is open."""


def refuse_open_units(source: str, text: str, is_angle: bool) -> None:
    """Raise `OpenUnit` where an angle has a number with a unit and one without, such as 180° - 55 or cos(180° - 55).

    Radians would be read, and degrees are meant as often; angles with π or of an arc function are in radians.

    Parameters
    ----------
    source : str
        A formula that `parse` reads.
    text : str
        As it was typed.
    is_angle : bool
        Whether the whole is an angle. Otherwise a sum can be of other quantities: 0.3*180° + 0.2 is a length.
    """
    # The formula keeps neither "rad" behind a number, nor whether "rad(...)" or ° has made radians of degrees.
    written = _UNIT_OF_RADIANS.sub("°", _RAD_OF.sub("atan", source))
    try:
        open_units = parse(written).folded(_Kinds()) == _OPEN and is_angle
    except OpenUnit:
        open_units = True
    if open_units:
        cut = text if len(text) <= 40 else text[:37] + "..."
        raise OpenUnit(f"In {cut!r} one angle has a unit and another has none: write it at each, as in 180° - 30°.")


_NUMBER, _RADIANS, _WITH_UNIT, _OPEN = range(4)
"""Kinds of terms: a number alone, an angle that is in radians by itself, one with a unit, and a sum of both."""


class _Kinds:
    """The fold of a formula to the kind of its value."""

    def number(self, value: float) -> int:
        """Return the kind of a number; zero is an angle in any unit."""
        return _RADIANS if value in (0.0, math.pi) else _NUMBER

    def name(self, name: str) -> int:
        """Return the kind of a variable, whose unit is known."""
        return _RADIANS

    def operation(self, operation: str, arguments: list[int]) -> int:
        """Return the kind of a sum, a product or a function; raise `OpenUnit` in a function of angles."""
        if operation in (*_OF_ANGLES, "deg") and _OPEN in arguments:
            raise OpenUnit
        if operation in ("+", "-", "min", "max"):
            return _OPEN if {_NUMBER, _WITH_UNIT} <= {*arguments} or _OPEN in arguments else _sum(arguments)
        if operation in ("*", "/"):
            return _NUMBER if arguments.count(_WITH_UNIT) == 2 else max(arguments)
        if operation in ("minus", "abs"):
            return arguments[0]
        if operation == "rad":
            return _WITH_UNIT
        return _RADIANS if operation in _IN_RADIANS else _NUMBER


def _sum(arguments: list[int]) -> int:
    """Return the kind of a sum: a number in it leaves the unit as open as it is."""
    return _NUMBER if _NUMBER in arguments else max(arguments)


def _stands_for(bracket: re.Match[str]) -> str:
    name = (bracket["name"] or "").lower()
    if name in _IN_RADIANS:
        return "pi"
    if name and name not in _KEEP:
        return "1"
    terms = [term for part in bracket["inside"].split(",") for term in angle_terms(part)]
    if any(units_in(term) == 1 for term in terms):
        return "1°"
    return "pi" if any(map(is_in_radians, terms)) else "1"
