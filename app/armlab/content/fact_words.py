"""Facts of benches in words with units: lengths and angles in those of the screen."""

from __future__ import annotations

from armlab.content.check import PLAIN, Words
from armlab.content.seen_fact import Value

UNKNOWN = "–"
"""Sign for a fact that is not known, or that the arm does not have."""

_DIGITS = 4
_LONGEST = 1e9
"""Number below which a whole number is written with all its digits."""

_ROUNDING = 1e-12
"""Magnitude below which a number is rounding: facts are in SI units, and smaller torques or speeds do not occur."""


def said(value: Value | None, unit: str, words: Words = PLAIN) -> str:
    """Return the value of a fact with its unit.

    >>> said(2.5, "N m"), said((0.5, -1.0), ""), said(True, ""), said(None, "m")
    ('2.5 N m', '(0.5, −1)', 'yes', '–')
    """
    if value is None:
        return UNKNOWN
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        of_screen = {"m": words.length, "rad": words.angle}.get(unit)
        if of_screen is not None:
            return f"({', '.join(map(of_screen, value))})"
        return f"({', '.join(map(_number, value))}) {unit}".rstrip()
    if unit in ("m", "rad"):
        return (words.length if unit == "m" else words.angle)(value)
    return f"{_number(value)} {unit}".rstrip()


def _number(value: float) -> str:
    if abs(value) == float("inf"):
        return "∞" if value > 0 else "−∞"
    value = 0.0 if abs(value) < _ROUNDING else value
    if value == int(value) and abs(value) < _LONGEST:
        return f"{int(value)}".replace("-", "\u2212")
    return f"{value + 0.0:.{_DIGITS}g}".replace("-", "\u2212")
