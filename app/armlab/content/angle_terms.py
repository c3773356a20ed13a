"""The terms of a formula as people type them, and which of them say in what unit their angles are."""

from __future__ import annotations

import re

from armlab.content.expressions import FUNCTIONS

_KEEP = ("abs", "min", "max")
"""Functions whose value is of the quantity of their arguments."""

_IN_RADIANS = ("asin", "acos", "atan", "atan2", "rad")
_NAMES = "|".join(sorted(FUNCTIONS, key=len, reverse=True))
_BRACKET = re.compile(rf"(?:(?<![a-z])(?P<name>{_NAMES})\s*)?\((?P<inside>[^()]*)\)", re.IGNORECASE)
_UNIT = re.compile(r"°|(?<![a-z])(?:deg|rad)(?![a-z])", re.IGNORECASE)
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
