"""Quantities as students type them: a number, which may be a small formula, and a unit."""

from __future__ import annotations

import math
import re

from armlab.content.expressions import Expression, parse
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

_SPELLINGS = {"°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "percent": "%"}
_UNIT = re.compile(
    r"(?<![a-zA-Z^/])(degrees?|deg|°|radians?|rad|rpm|cm|mm|ms|mN[ *]?m|mA|mW|kW|m|s|N[ *]?m|N|V|A|W|%|percent)"
    r"(?:(?P<square>\s*\^?2|\s*\^\(2\))|(?P<second>\s*/\s*s|[ *]*s\^\(?-1\)?))?$"
)


def read_quantity(text: str) -> tuple[float, str | None]:
    """Return the number and the unit, None when there is none, of an answer as typed.

    Raises
    ------
    InputError
        It cannot be read.

    Examples
    --------
    >>> read_quantity("50 cm"), read_quantity("0,5"), read_quantity("90°"), read_quantity("2·10⁻³ m")
    ((50.0, 'cm'), (0.5, None), (90.0, 'deg'), (0.002, 'm'))
    """
    expression, unit = read_formula(text)
    try:
        return expression.value({}), unit
    except InputError:
        raise _unreadable(text) from None


def read_formula(text: str) -> tuple[Expression, str | None]:
    """Return the quantity with the number as it was written; see `read_quantity`."""
    source, unit = _without_unit(plain_symbols(text).strip())
    try:
        return parse(with_decimal_points(source)), unit
    except InputError:
        raise _unreadable(text) from None


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


def _without_unit(source: str) -> tuple[str, str | None]:
    found = _UNIT.search(source)
    if found is None:
        return source, None
    name = re.sub("[ *]", "", found[1])
    unit = _SPELLINGS.get(name, name) + ("^2" if found["square"] else "/s" if found["second"] else "")
    if unit not in UNITS:
        raise InputError(f"The unit {unit} is not known; there are {', '.join(filter(None, UNITS))}.")
    return source[: found.start()].strip(), unit


def _unreadable(text: str) -> InputError:
    cut = text if len(text) <= 40 else text[:37] + "..."
    return InputError(f"I cannot read {cut!r}: write a number such as 0.5, 50 cm, pi/2 or 90 deg.")
