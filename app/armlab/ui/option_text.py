"""Typed options of paths and laws: read in the units on screen, and refused with where, what and the range."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.ui.format import readable
from armlab.ui.units import ANGLES as SIZES
from armlab.ui.units import RELATIVE, remark_on_radians

DECIMALS = 4


@dataclass(frozen=True)
class Scale:
    """Unit on screen that stands for the unit ``q`` of a coordinate.

    Attributes
    ----------
    unit : str
        Such as ``"°"``; empty for a pure number.
    factor : float
        The size of the unit on screen in radians or metres.
    """

    unit: str = ""
    factor: float = 1.0


ANGLES = ("°", "rad")

PLAIN = (Scale(),)


def unit_text(field: Field, scale: Scale) -> str:
    """Return the unit of an option on screen; empty for a pure number.

    >>> unit_text(Field("v", "v", "speed", "number", unit="q/s"), Scale("mm", 1e-3))
    'mm/s'
    """
    unit = field.unit
    if unit.startswith("q"):
        return (scale.unit or "1") + unit[1:] if unit != "q" else scale.unit
    return {"1": "", "rad": "°"}.get(unit, unit)


def factor_of(field: Field, scale: Scale) -> float:
    """Return the size of the unit on screen."""
    if field.unit.startswith("q"):
        return scale.factor
    return float(np.pi / 180.0) if field.unit == "rad" else 1.0


def scale_of(kind: Field, scales: Sequence[Scale], j: int) -> Scale:
    """Return the scale of the number of index j of an option."""
    if kind.kind in ("vector", "rows"):
        return scales[min(j, len(scales) - 1)]
    return next((scale for scale in scales if scale.unit in ANGLES), scales[0])


def option_value(kind: Field, text: str, now: Any = None, scales: Sequence[Scale] = PLAIN, needed: bool = False) -> Any:
    """Return a typed or pressed value of an option, radians and metres, or None if the field was emptied.

    Parameters
    ----------
    kind : Field
    text : str
    now : value
        The present value: pressing a truth value turns it round.
    scales : sequence of Scale
    needed : bool
        Whether a number must be there.

    Raises
    ------
    InputError
        Not numbers, or out of range; the text names the option as the form does, and gives the range in the unit on
        screen.

    Examples
    --------
    >>> option_value(Field("gain", "K", "gain; large: fast", "number", 1.0, 0.0, 100.0), "-1")
    Traceback (most recent call last):
    armlab.errors.InputError: K (gain): expected a number from 0 to 100, got '-1'
    """
    if kind.kind == "flag":
        return not (kind.default if now is None else now)
    if kind.kind == "choice":
        return text
    if not text.strip():
        if needed:
            raise _wrong(kind, text, scales)
        return None
    if kind.kind == "rows":
        return [_read(kind, row, scales) for row in text.replace("\n", ";").split(";") if row.strip()]
    numbers = _read(kind, text, scales)
    if kind.kind in ("vector", "list"):
        return numbers
    return round(numbers[0]) if kind.kind == "whole" else numbers[0]


def _read(kind: Field, text: str, scales: Sequence[Scale]) -> list[float]:
    """Return the numbers of a line."""
    words, one = _words(text), kind.kind in ("number", "whole")
    if one and len(words) != 1:
        raise _wrong(kind, text, scales)
    found = []
    for j, word in enumerate(words):
        try:
            value = _number(kind, word.replace(",", "."), scale_of(kind, scales, j))
        except InputError:
            raise _wrong(kind, text if one else word, scales, j) from None
        value = _within(kind, value, factor_of(kind, scale_of(kind, scales, j)))
        too_low = value <= kind.low if kind.above else value < kind.low
        if too_low or value > kind.high or (kind.kind == "whole" and value != round(value)):
            raise _wrong(kind, text if one else word, scales, j)
        found.append(value)
    return found


def _within(kind: Field, value: float, factor: float) -> float:
    """Return a bound for a value that passes it by no more than its rounding: 6.2832 rad is as far as a whole turn."""
    for bound, passed in ((kind.low, value < kind.low and not kind.above), (kind.high, value > kind.high)):
        if passed and abs(value - bound) <= min(0.5 * 10.0**-DECIMALS * factor, RELATIVE * abs(bound)):
            return bound
    return value


def _number(kind: Field, word: str, scale: Scale) -> float:
    """Return a typed number, radians or metres; an angle may have its unit."""
    unit = unit_text(kind, scale)
    if unit in ANGLES:
        for ending, size in SIZES.items():
            if word.endswith(ending):
                return evaluate(word.removesuffix(ending)) * size
    value = evaluate(word) * factor_of(kind, scale)
    if unit == "rad" and "pi" not in word and "π" not in word:
        remark_on_radians(value)
    return value


def _words(text: str) -> list[str]:
    """Return the words of a text between blanks, with or without commas, each number with its unit."""
    return re.sub(r"\s+(deg|°|rad)(?!\w)", r"\1", text.replace(", ", " ").replace("−", "-")).split()


def _wrong(kind: Field, text: str, scales: Sequence[Scale], j: int = 0) -> InputError:
    """Return the refusal of a typed text: what it is for, what was expected there, and what came."""
    title = re.split("; |, 0: |: ", kind.title)[0]
    where = f"{kind.symbol} ({title})" if kind.symbol and kind.symbol != title else title
    numbers = {"number": "a number", "whole": "a whole number"}.get(kind.kind, "numbers")
    scale = scale_of(kind, scales, j)
    unit = unit_text(kind, scale)
    expected = " ".join(filter(None, (numbers, f"in {unit}" if unit else "", _range(kind, scale))))
    expected += ", separated by blanks" if numbers == "numbers" else ""
    got = repr(text.strip()[:40]) if text.strip() else "nothing"
    return InputError(f"{where}: expected {expected}, got {got}")


def _range(kind: Field, scale: Scale) -> str:
    """Return the range of an option in words, in the unit on screen; empty if there is none."""
    low, high = (_bound(bound / factor_of(kind, scale)) for bound in (kind.low, kind.high))
    if math.isinf(kind.low):
        return "" if math.isinf(kind.high) else f"of at most {high}"
    if math.isinf(kind.high):
        return f"greater than {low}" if kind.above else f"of at least {low}"
    return f"greater than {low} and at most {high}" if kind.above else f"from {low} to {high}"


def _bound(value: float) -> str:
    return "" if math.isinf(value) else readable(value, DECIMALS)
