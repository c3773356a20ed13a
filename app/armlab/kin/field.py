"""One option that can be set, described so that it can be checked and shown in a form."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from armlab.errors import InputError, UnknownName
from armlab.kin.checks import as_floats, whole_number, wrong
from armlab.registry import known_name

Kind = Literal["number", "whole", "choice", "flag", "vector", "list", "rows", "text"]
Options = Mapping[str, Any]

ROUNDING = 1e-9
"""Angle, radians, by which a value may pass a bound and then is the bound: with nine decimals, as links have, π is
larger than it is."""


@dataclass(frozen=True)
class Field:
    """An option, described so that a form can be made of it.

    Attributes
    ----------
    key, symbol, title : str
        The name in programs, the symbol of the notes, and the name in words.
    kind : str
        ``"number"``, ``"whole"`` number, ``"choice"``, ``"flag"``; ``"vector"``: one number a coordinate; ``"list"``:
        one number for each waypoint or segment; ``"rows"``: a table of numbers; ``"text"``.
    default : object
        None: may be left out, and then something sensible is chosen, which the title says.
    low, high : float
        Smallest and largest value of a number; of a text the most characters.
    above : bool
        Whether ``low`` itself is too small.
    unit : str
        ``"1"``, ``"s"``, ``"rad"``; with ``q`` for the unit of the coordinates: ``"q"``, ``"q/s"``, ``"q/s²"``.
    choices : tuple of (str, str)
        Key and words of each choice.
    only : tuple of (str, tuple of (str or None))
        Options this one depends on, and their values with which it can be used, None: left out; empty: always.
    by : tuple of (str, str, str, str)
        Option, value, symbol, unit: symbol and unit are these while the option has the value, and else as above.
    was : str
        Key by which works that were saved before may call it.
    """

    key: str
    symbol: str
    title: str
    kind: Kind
    default: Any = None
    low: float = -math.inf
    high: float = math.inf
    above: bool = False
    unit: str = "1"
    choices: tuple[tuple[str, str], ...] = ()
    only: tuple[tuple[str, tuple[str | None, ...]], ...] = ()
    by: tuple[tuple[str, str, str, str], ...] = ()
    was: str = ""

    @property
    def converted(self) -> bool:
        """Whether the value may be typed in another unit, so that messages must not quote the internal number."""
        return self.unit.startswith("q") or self.unit == "rad"

    def usable(self, options: Options) -> bool:
        """Return whether the option can be used with these values of the other options, by key."""
        given = ((options.get(key), values) for key, values in self.only)
        return all((value is None or isinstance(value, str)) and value in values for value, values in given)

    def seen(self, options: Options) -> Field:
        """Return the option with the symbol and unit it has at these values of the other options."""
        for key, value, symbol, unit in self.by:
            if options.get(key) == value:
                return replace(self, symbol=symbol, unit=unit)
        return self

    def checked(self, value: Any) -> Any:
        """Return the checked value: float, int, bool, str, array, or None where it may be left out.

        Raises
        ------
        InputError
            Of another kind, out of range, or not finite; the text names the option.
        """
        if value is None and self.default is None:
            return None
        if self.kind == "flag":
            if not isinstance(value, (bool, np.bool_)):
                raise wrong(self.key, "True or False", value)
            return bool(value)
        if self.kind == "choice":
            keys = [key for key, _ in self.choices]
            if value not in keys:
                raise UnknownName(self.key, value, map(str, keys))
            return keys[keys.index(value)]
        if self.kind == "text":
            if not isinstance(value, str) or len(value) > self.high:
                raise wrong(self.key, f"a text of at most {self.high:g} characters", value)
            return value
        if self.kind == "whole":
            whole = whole_number(value, self.key, int(self.low))
            if whole > self.high:
                raise wrong(self.key, f"a whole number, at most {self.high:g}", value)
            return whole
        array = as_floats(value, self.key, "numbers")
        if not np.isfinite(array).all():
            raise wrong(self.key, "finite numbers", value)
        if self.unit == "rad":
            inside = np.clip(array, self.low, self.high)
            array = np.where(np.abs(array - inside) <= ROUNDING, inside, array)
        self._check_range(array, value)
        if self.kind == "number":
            if array.shape != ():
                raise wrong(self.key, "one number", value)
            return float(array)
        if self.kind == "rows":
            if array.ndim != 2:
                raise wrong(self.key, "rows of numbers", value)
            return array
        if array.ndim > 1:
            raise wrong(self.key, "numbers in one row", value)
        return np.atleast_1d(array)

    def _check_range(self, array: np.ndarray[Any, np.dtype[np.float64]], value: Any) -> None:
        too_low = array <= self.low if self.above else array < self.low
        if not (np.any(too_low) or np.any(array > self.high)):
            return
        if self.converted and np.any(too_low) and self.low == 0.0:
            raise InputError(f"{self.key}: expected {'a positive number' if self.above else 'no negative number'}")
        unit = "" if self.converted or self.unit == "1" else self.unit
        factor, ending = (math.degrees(1.0), "°") if self.unit == "rad" else (1.0, f" {unit}" if unit else "")
        least = f"{'more than' if self.above else 'at least'} {self.low * factor:g}{ending}"
        most = f"at most {self.high * factor:g}{ending}"
        parts = ((least, self.low), (most, self.high))
        expected = " and ".join(text for text, limit in parts if not math.isinf(limit))
        if self.converted:
            raise InputError(f"{self.key}: expected {expected}")
        got = array[too_low | (array > self.high)][0] if array.ndim else value
        raise wrong(self.key, expected, got, unit)


def checked_options(where: str, fields: Iterable[Field], given: Options) -> dict[str, Any]:
    """Return all options by key, those not given at their defaults.

    Raises
    ------
    InputError
        An unknown option, or one with a wrong value.
    """
    known = {field.key: field for field in fields}
    for key in given:
        known_name(f"options of {where}", key, known)
    return {key: field.checked(given.get(key, field.default)) for key, field in known.items()}


def seen_fields(fields: Iterable[Field], given: Options) -> tuple[Field, ...]:
    """Return the options that can be used with those given, in order, with the symbols and units they then have."""
    fields = tuple(fields)
    options = {field.key: given.get(field.key, field.default) for field in fields}
    return tuple(field.seen(options) for field in fields if field.usable(options))


def positive(value: object, where: str) -> float:
    """Return a positive finite number; `InputError` otherwise."""
    number = as_floats(value, where, "a positive number")  # type: ignore[arg-type]
    if number.shape != () or not np.isfinite(number) or number <= 0.0:
        raise wrong(where, "a positive number", value)
    return float(number)


def positive_bounds(values: Any, where: str, m: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return m positive numbers, possibly infinite; one number stands for all. `InputError` names the coordinate."""
    array = as_floats(values, where, f"{m} positive numbers")
    if array.shape not in ((), (m,)):
        raise wrong(where, f"{m} positive numbers", values)
    array = np.array(np.broadcast_to(array, (m,)))
    for j, value in enumerate(array):
        if not value > 0.0:
            raise InputError(f"{where} of joint {j + 1}: expected a positive number, got {value:g}")
    return array
