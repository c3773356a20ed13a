"""Conversion of arguments to arrays and numbers; wrong ones are refused with a sentence."""

from __future__ import annotations

import reprlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError


class _Short(reprlib.Repr):
    """Writes numbers with six digits, and arrays as the lists a person would type."""

    def repr1(self, x: Any, level: int) -> str:
        return super().repr1(x.tolist() if isinstance(x, (np.ndarray, np.generic)) else x, level)

    def repr_float(self, x: float, level: int) -> str:
        return f"{x:.6g}"


_SHORT = _Short()
_SHORT.maxother = _SHORT.maxstring = 80


def as_floats(values: ArrayLike | None, where: str, expected: str) -> NDArray[np.float64]:
    """Return a new array of floats.

    Raises
    ------
    InputError
        Text, complex numbers, ragged lists, or numbers too large: "where: expected ..., got ...".
    """
    try:
        array = np.array(values)
        if array.dtype.kind in "cSU":  # NumPy would drop the imaginary part, and read the text
            raise wrong(where, expected, values)
        return array.astype(float, copy=False)
    except InputError:
        raise
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


def whole_between(value: object, where: str, least: int, most: int) -> int:
    """Return an integer from ``least`` to ``most``; `InputError` otherwise.

    >>> whole_between(20, "teeth", 6, 200)
    20
    """
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise wrong(where, f"a whole number from {least} to {most}", value)
    return int(value)


def together(**shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape of all batches together, from the shape of each by the name of its argument.

    Raises
    ------
    InputError
        They do not broadcast.
    """
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        got = ", ".join(str(shape) for shape in shapes.values())
        raise InputError(f"{', '.join(shapes)}: expected as many of each, or one, got batches of shape {got}") from None


def wrong(where: str, expected: str, got: object, unit: str = "") -> InputError:
    """Return the error for a wrong argument; a long value is shortened, and followed by its unit.

    >>> str(wrong("speed", "one number", np.array([0.5, -1 / 3])))
    'speed: expected one number, got [0.5, -0.333333]'
    """
    return InputError(f"{where}: expected {expected}, got {_SHORT.repr(got)}{f' {unit}' if unit else ''}")
