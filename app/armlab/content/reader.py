"""Reading of TOML tables, with checks whose messages a teacher can act on."""

from __future__ import annotations

import datetime
import math
import tomllib
from collections.abc import Iterable
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from armlab.errors import ContentError, suggestion

_UNITS = ("_deg_s2", "_m_s2", "_deg_s", "_m_s", "_deg_m", "_deg", "_m")
"""Suffixes of units, longest first, so that removing one leaves the bare name."""


_MOST_SHOWN = 60


class Table:
    """One table of a file. Take every value by its key, then call `done`: what was not taken is an error.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    data : dict
        The parsed table.
    where : str
        Its place in the file, such as ``joints[2]``.
    """

    def __init__(self, file: str, data: dict[str, Any], where: str = "") -> None:
        self.file, self.where = file, where
        self._data, self._known = data, set[str]()

    @classmethod
    def parse(cls, file: str, text: str) -> Self:
        """Parse a whole file, with or without a byte order mark; broken TOML is reported with its line."""
        try:
            return cls(file, tomllib.loads(text.removeprefix("\ufeff")))
        except tomllib.TOMLDecodeError as error:
            raise ContentError(file, "", f"not valid TOML: {error}") from None
        except ValueError:  # Python does not convert more than 4300 digits
            raise ContentError(file, "", "a number has too many digits; write it with an exponent") from None
        except RecursionError:
            raise ContentError(file, "", "brackets are nested too deep; expected a list of lists at most") from None

    def fail(self, key: str, problem: str) -> ContentError:
        """Return the error for a key of this table."""
        return ContentError(self.file, self._path(key), problem)

    def has(self, key: str) -> bool:
        """Return whether the file has this key; it then has to be taken."""
        self._known.add(key)
        return key in self._data

    def text(self, key: str, default: str | None = None) -> str:
        """Take a string that is not empty."""
        value = self._take(key, default)
        if not isinstance(value, str) or not (value.strip() or value == default):
            raise self.fail(key, f"expected a text, got {shown(value)}")
        return value

    def choice(self, key: str, options: Iterable[str], default: str | None = None) -> str:
        """Take one of several words."""
        value, names = self.text(key, default), list(options)
        if value not in names:
            raise self.fail(key, f"unknown value {value!r}{suggestion(value, names)}")
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        """Take a list of texts; an empty tuple when it is missing."""
        value = self._take(key, [])
        if not isinstance(value, list) or not all(isinstance(entry, str) and entry.strip() for entry in value):
            raise self.fail(key, f"expected a list of texts, got {shown(value)}")
        return tuple(value)

    def value(self, key: str, default: Any = None) -> Any:
        """Take a value of any kind, unchanged."""
        return self._take(key, default)

    def boolean(self, key: str, default: bool) -> bool:
        """Take true or false."""
        value = self._take(key, default)
        if not isinstance(value, bool):
            raise self.fail(key, f"expected true or false, got {shown(value)}")
        return value

    def number(self, key: str, default: float | None = None) -> float:
        """Take a finite number."""
        return self._number(key, self._take(key, default))

    def numbers(self, key: str, count: int, default: list[float] | None = None) -> NDArray[np.float64]:
        """Take a list of ``count`` finite numbers, shape (count,)."""
        value = self._take(key, default)
        if not isinstance(value, list) or len(value) != count:
            raise self.fail(key, f"expected {count} numbers in brackets, got {shown(value)}")
        return np.array([self._number(f"{key}[{i + 1}]", entry) for i, entry in enumerate(value)])

    def matrix(self, key: str) -> NDArray[np.float64]:
        """Take a matrix, shape (3, 3), written as a list of rows."""
        value = self._take(key, None)
        if not isinstance(value, list) or [len(row) if isinstance(row, list) else 0 for row in value] != [3, 3, 3]:
            raise self.fail(key, f"expected three rows of three numbers, got {shown(value)}")
        return np.array([[self._number(key, entry) for entry in row] for row in value])

    def rows(self, key: str) -> NDArray[np.float64]:
        """Take a matrix of any shape, a list of rows of equal length."""
        value = self._take(key, None)
        if not isinstance(value, list) or not value or not all(isinstance(row, list) and row for row in value):
            raise self.fail(key, f"expected rows of numbers such as [[1, 0], [0, 1]], got {shown(value)}")
        if len({len(row) for row in value}) != 1:
            raise self.fail(key, f"expected rows of equal length, got {', '.join(str(len(row)) for row in value)}")
        return np.array([[self._number(key, entry) for entry in row] for row in value])

    def table(self, key: str) -> Table | None:
        """Take a table, or None when there is none."""
        value = self._take(key, {})
        if not isinstance(value, dict):
            raise self.fail(key, f"expected a table [{key}], got {shown(value)}")
        return Table(self.file, value, self._path(key)) if key in self._data else None

    def tables(self, key: str) -> list[Table]:
        """Take an array of tables; an empty list when it is missing."""
        value = self._take(key, [])
        if not isinstance(value, list) or not all(isinstance(entry, dict) for entry in value):
            raise self.fail(key, f"expected tables [[{key}]], got {shown(value)}")
        return [Table(self.file, entry, f"{self._path(key)}[{i + 1}]") for i, entry in enumerate(value)]

    def done(self) -> None:
        """Report the first key that was not taken."""
        for key in self._data:
            if key in self._known:
                continue
            with_unit = [key + unit for unit in _UNITS if key + unit in self._known]
            if with_unit:
                raise self.fail(key, f"the unit belongs into the name: write {' or '.join(with_unit)}")
            raise self.fail(key, f"unknown key{suggestion(key, self._known)}")

    def _take(self, key: str, default: Any) -> Any:
        self._known.add(key)
        if key in self._data:
            return self._data[key]
        if default is None:
            bare = next((key.removesuffix(unit) for unit in _UNITS if key.endswith(unit)), key)
            if bare != key and bare in self._data:
                raise self.fail(bare, f"the unit belongs into the name: write {key}")
            raise self.fail(key, f"missing; the file has {', '.join(self._data) or 'nothing here'}")
        return default

    def _number(self, key: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.fail(key, f"expected a number, got {shown(value)}")
        try:
            number = float(value)
        except OverflowError:
            raise self.fail(key, f"expected a number below 1.8e308, got {shown(value)}") from None
        if not math.isfinite(number):
            raise self.fail(key, f"expected a finite number, got {shown(value)}")
        return number

    def _path(self, key: str) -> str:
        return f"{self.where}.{key}" if self.where else key


def shown(value: object) -> str:
    """Return a value as it is written, cut to what fits into a message.

    >>> shown([1.0, "a"]), shown(datetime.time(10, 0))
    ("[1.0, 'a']", '10:00:00')
    """
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    try:
        text = repr(value)
    except (ValueError, RecursionError):
        return f"{type(value).__name__} too long to be shown"
    return text if len(text) <= _MOST_SHOWN else text[: _MOST_SHOWN - 3] + "..."


def joint_values(table: Table, kinds: str) -> NDArray[np.float64]:
    """Take joint values ``q_deg`` (all revolute), ``q_m`` (all prismatic) or ``q_deg_m`` (each in its own unit).

    Parameters
    ----------
    table : Table
    kinds : str
        One letter R or P for each joint.

    Returns
    -------
    ndarray, shape (n,)
        Radians and metres.
    """
    key = {"R": "q_deg", "P": "q_m"}.get("".join(sorted(set(kinds))), "q_deg_m")
    values = table.numbers(key, len(kinds))
    revolute = np.array([kind == "R" for kind in kinds])
    return np.where(revolute, np.radians(values), values)
