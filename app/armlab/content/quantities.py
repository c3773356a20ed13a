"""Quantities as students type them: a number, which may be a small formula, and a unit."""

from __future__ import annotations

import math
import re
from collections import Counter

from armlab.content.angle_terms import angle_terms, is_in_radians, refuse_open_units, units_in
from armlab.content.expressions import LONGEST, Expression, parse
from armlab.content.symbols import plain_symbols
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
    "mNm": ("a torque", 1e-3),
    "rpm": ("an angular speed", 2.0 * math.pi / 60.0),
    "m/s^2": ("an acceleration", 1.0),
    "rad/s^2": ("an angular acceleration", 1.0),
    "deg/s^2": ("an angular acceleration", math.pi / 180.0),
    "1/s": ("a rate", 1.0),
    "1/s^2": ("a rate per second", 1.0),
    "m/rad": ("a length per angle", 1.0),
    "1/m": ("a curvature", 1.0),
    "1/m^2": ("one over an area", 1.0),
    "m^2/s": ("an area per second", 1.0),
    "Ns/m": ("a damping", 1.0),
    "V": ("a voltage", 1.0),
    "A": ("a current", 1.0),
    "mA": ("a current", 1e-3),
    "W": ("a power", 1.0),
    "mW": ("a power", 1e-3),
    "kW": ("a power", 1e3),
    "%": ("a share", 1e-2),
}
"""Units, each with its kind of quantity and its size in the unit of computation."""

ROUNDING = 1e-9
"""Relative widening of a tolerance, so that a number exactly on its edge is right."""

_SPELLINGS = {
    "°": "deg",
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "percent": "%",
    "Nm": "N m",
    "mNm": "mN m",
    "Ns": "N s",
}
_NAME = "degrees?|deg|°|radians?|rad|rpm|cm|mm|ms|mNm|mN|mA|mW|kW|m|s|Nm|Ns|N|V|A|W|%|percent"
_FACTOR = rf"(?:{_NAME})(?:\s*\^\s*\(?[+-]?[1-3]\)?|\s*[23])?"
"""A unit with its power: m, s^2, s^(-1), m2."""

_UNIT = re.compile(
    rf"(?:(?<![a-zA-Z^/]){_FACTOR}|(?:(?<=[\w.)])\s+1\s*)?/\s*{_FACTOR})(?:\s*[/*]\s*{_FACTOR}|\s+{_FACTOR})*$"
)
"""A product of powers of units at the end of a quantity: m/s^2, rad s^-2, N*m, 1/s."""

_WORD = re.compile(r"(?<![a-zA-Z])(deg|rad)(?:rees?|ians?)?(?![a-zA-Z])", re.IGNORECASE)
"""A unit of angles, short or written out, with small letters or large ones as formulas take it."""

_PART = re.compile(rf"(?P<over>/)?[\s*]*(?P<name>{_NAME})(?:\s*\^?\s*\(?(?P<power>[+-]?[1-3]))?")


def read_quantity(text: str, asked: str = "") -> tuple[float, str | None]:
    """Return the number and the unit, None when there is none, of an answer as typed.

    Parameters
    ----------
    text : str
    asked : str
        The unit that is asked for.

    Raises
    ------
    InputError
        It cannot be read, or of two angles one has a unit and the other has none.

    Examples
    --------
    >>> read_quantity("50 cm"), read_quantity("0,5"), read_quantity("90°"), read_quantity("2·10⁻³ m")
    ((50.0, 'cm'), (0.5, None), (90.0, 'deg'), (0.002, 'm'))
    """
    expression, unit = read_formula(text, asked)
    try:
        return expression.value({}), unit
    except InputError:
        raise _unreadable(text, asked) from None


def read_formula(text: str, asked: str = "") -> tuple[Expression, str | None]:
    """Return the quantity with the number as it was written; see `read_quantity`.

    Parameters
    ----------
    text : str
    asked : str
        The unit that is asked for: examples are given in it to a person whose answer cannot be read, and it tells what
        an angle with its own unit is part of, such as an angular speed.
    """
    if len(text) > LONGEST:
        raise _unreadable(text, asked)
    source = _WORD.sub(lambda word: word[1].lower(), plain_symbols(text).strip())
    source, unit = _without_unit(source, asked)
    source = with_decimal_points(source)
    try:
        formula = parse(source)
    except InputError:
        raise _unreadable(text, asked) from None
    refuse_open_units(source, text.strip(), UNITS[asked][0].startswith(("an angle", "an angular")))
    return formula, unit


def with_decimal_points(source: str) -> str:
    """Return a number with a point in place of a decimal comma; commas between the values of a function stay.

    >>> with_decimal_points("0,5"), with_decimal_points("atan2(1,2)")
    ('0.5', 'atan2(1,2)')
    """
    alone = source.count(",") == 1 and "." not in source and not re.search(r"(atan2|min|max)\s*\(", source)
    return re.sub(r"(?<=\d),(?=\d)", ".", source) if alone else source


def is_near(value: float, answer: float, tolerance: float) -> bool:
    """Return whether a number is within a tolerance, edges included."""
    return abs(value - answer) <= tolerance * (1.0 + ROUNDING)


def _without_unit(source: str, asked: str) -> tuple[str, str | None]:
    """Return a formula and its unit: without the unit at its end, unless this belongs to the last term only.

    Angles that are read with their unit are in radians: 180° - 30°, pi - 30° and 90°/2 are.
    """
    found = _UNIT.search(source)
    terms = angle_terms(source)
    if found is None:
        has_angle = any(units_in(term) == 1 for term in terms)
        return source, asked.replace("deg", "rad") if has_angle and re.search("deg|rad", asked) else None
    unit = _BY_POWERS.get(_powers(found[0]))
    if unit is None:
        written = re.sub(r"[\s()]", "", found[0])
        raise InputError(f"The unit {written} is not known; there are {', '.join(filter(None, UNITS))}.")
    *before, last = terms
    if unit in ("deg", "rad") and (units_in(last) > 1 or any(units_in(term) or is_in_radians(term) for term in before)):
        return source, "rad" if any(units_in(term) == 1 for term in terms) else None
    number = source[: found.start()].strip().removesuffix("*").rstrip()
    return number or "1" * found[0].startswith("/"), unit


def _powers(written: str) -> frozenset[tuple[str, int]]:
    """Return the units of a product with their powers, so that m/s^2, m s^-2 and m/s/s are the same.

    >>> sorted(_powers("rad/s^2"))
    [('rad', 1), ('s', -2)]
    """
    powers: Counter[str] = Counter()
    for part in _PART.finditer(written):
        power = int(part["power"] or 1) * (-1 if part["over"] else 1)
        for name in _SPELLINGS.get(part["name"], part["name"]).split():
            powers[name] += power
    return frozenset((name, power) for name, power in powers.items() if power)


_BY_POWERS = {_powers(unit): unit for unit in UNITS if unit}


_EXAMPLES = {"a length": "0.5, 1/2 or 50 cm", "an angle": "0.5, pi/2 or 90 deg", "a pure number": "0.5, 1/2 or sqrt(2)"}
"""Examples of answers, by the quantity that is asked for."""


def _unreadable(text: str, asked: str = "") -> InputError:
    cut = text if len(text) <= 40 else text[:37] + "..."
    examples = _EXAMPLES.get(UNITS[asked][0], f"0.5, 1/2 or 0.5 {asked}")
    return InputError(f"I cannot read {cut!r}: write a number such as {examples}.")
