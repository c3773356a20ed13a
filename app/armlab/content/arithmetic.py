"""Numbers as people write them: ``-pi/2``, ``3π/4``, ``sqrt(2)/2``."""

from __future__ import annotations

import math
import re

import numpy as np

from armlab.content.expressions import parse
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError

LONGEST = 120
"""Largest number of characters of an expression; more come from a wrongly split table, or an attack."""

_PLAIN = re.compile("-?[0-9]{1,15}(?:[.][0-9]{0,20})?")
"""Pattern of plain decimal numbers, the usual case, which need no parsing."""


def evaluate(text: str) -> float:
    """Return the value of an expression of numbers, pi, sqrt, + - * / ^ and brackets.

    A product may leave out its sign, as in ``3pi/4``; it is then evaluated from left to right like any other.

    Raises
    ------
    InputError
        Anything else, or a value that is not finite.

    Examples
    --------
    >>> evaluate("-pi/2") == -math.pi / 2, evaluate("2 sqrt(2)") == 2 * math.sqrt(2)
    (True, True)
    """
    if _PLAIN.fullmatch(text):
        return float(text)
    # A long text is refused before it is looked at: looking takes the square of its length.
    source = plain_symbols(text) if len(text.strip()) <= LONGEST else ""
    if not source or len(source.strip()) > LONGEST or "°" in source:
        raise _unreadable(text)
    try:
        return parse(source, functions=("sqrt",)).value({})
    except InputError:
        raise _unreadable(text) from None


def shortest_degrees(value: float) -> str:
    """Return the shortest number of degrees that NumPy turns into this float of radians, or the nearest there is.

    >>> shortest_degrees(float(np.radians(90.0))), shortest_degrees(-math.pi / 6)
    ('90', '-30')
    """
    degrees = math.degrees(value)
    candidates = [float(f"{degrees:.{digits}g}") for digits in range(1, 18)]
    candidates += [math.nextafter(degrees, math.inf), math.nextafter(degrees, -math.inf)]
    return shortest(min(candidates, key=lambda candidate: abs(float(np.radians(candidate)) - value)))


def shortest(value: float) -> str:
    """Return a number that reads back as the same float, without a useless ``.0``.

    >>> shortest(1.0), shortest(0.1), shortest(-0.0)
    ('1', '0.1', '0')
    """
    text = repr(value + 0.0)
    return text.removesuffix(".0")


def _unreadable(text: str) -> InputError:
    cut = text if len(text) <= 40 else text[:37] + "..."
    return InputError(f"expected a number such as 0.5, -pi/2 or sqrt(2)/2, got {cut!r}")
