"""Turn what a caller gives into numbers, or say what is wrong with it."""

from __future__ import annotations

import reprlib

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError

_SHORT = reprlib.Repr()
_SHORT.maxother = _SHORT.maxstring = 80


def as_floats(values: ArrayLike | None, where: str, expected: str) -> NDArray[np.float64]:
    """Return a new array of floats.

    Raises
    ------
    InputError
        Text, ragged lists, or numbers too large: "where: expected ..., got ...".
    """
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise wrong(where, expected, values) from None


def finite_floats(values: ArrayLike | None, where: str, shape: tuple[int, ...], expected: str) -> NDArray[np.float64]:
    """Return a new array of finite floats of this shape; `InputError` otherwise."""
    array = as_floats(values, where, expected)
    if array.shape != shape or not np.isfinite(array).all():
        raise wrong(where, expected, values)
    return array


def whole_number(value: object, where: str, least: int) -> int:
    """Return an integer not below ``least``; `InputError` otherwise."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise wrong(where, f"a whole number, at least {least}", value)
    return int(value)


def wrong(where: str, expected: str, got: object) -> InputError:
    """Return the error for an argument that is not what it should be; what came is shortened when long."""
    return InputError(f"{where}: expected {expected}, got {_SHORT.repr(got)}")
