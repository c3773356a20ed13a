"""Values of formulas at many points at once, with complex numbers and principal values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from armlab.content.expressions import LARGEST_POWER
from armlab.errors import InputError

Complexes = NDArray[np.complex128]

CONSTANTS: dict[str, complex] = {"e": complex(math.e), "i": 1j}
"""Letters that are numbers."""

REAL = 1e-12
"""Largest imaginary part of a number that counts as real, in its own size: rounding of complex powers."""


class Values:
    """The values of a formula at points.

    Parameters
    ----------
    given : mapping of str to ndarray, shape (N,)
        Values of the variables.
    count : int
        N.

    Attributes
    ----------
    largest : ndarray, shape (N,)
        The largest absolute value of any part of the formula; infinite where a part has none.
    """

    def __init__(self, given: Mapping[str, Complexes], count: int) -> None:
        self._given, self._count = given, count
        self.largest = np.zeros(count)

    def number(self, value: float) -> Complexes:
        """Return a number at all points."""
        return self._seen(np.full(self._count, complex(value)))

    def name(self, name: str) -> Complexes:
        """Return the values of a variable, or of e or i."""
        if name in CONSTANTS:
            return np.full(self._count, CONSTANTS[name])
        return self._seen(self._given[name])

    def operation(self, operation: str, arguments: list[Complexes]) -> Complexes:
        """Return the values of an operation or a function."""
        return self._seen(np.asarray(_OPERATIONS[operation](*arguments), dtype=complex))

    def _seen(self, values: Complexes) -> Complexes:
        values = values + 0.0  # zeros without a sign: roots and logarithms of negative numbers then have one value
        size = np.abs(values)
        self.largest = np.maximum(self.largest, np.where(np.isfinite(size), size, np.inf))
        return values


def _power(base: Complexes, exponent: Complexes) -> Complexes:
    finite = np.abs(exponent[np.isfinite(exponent)])
    if finite.size and float(finite.min()) > LARGEST_POWER:
        raise InputError(f"a power of {float(finite.min()):g} is too large; at most {LARGEST_POWER:g}")
    # Whole powers by multiplication keep the sign of zero and every digit, where exp and ln would lose some.
    whole = _real(exponent)
    small = np.isfinite(whole) & (np.round(whole) == whole) & (np.abs(whole) <= 32.0)
    found = np.where(small, 1.0, np.power(base, exponent))
    if small.any():
        for k in np.unique(whole[small]).tolist():
            at = small & (whole == k)
            found[at] = base[at] ** int(k)
    return np.asarray(found)


def _real(values: Complexes) -> NDArray[np.float64]:
    """Return real numbers; what is not real is not a number."""
    near = np.abs(values.imag) <= REAL * np.maximum(1.0, np.abs(values))
    return np.where(near, values.real, np.nan)


def _of_reals(function: Callable[..., NDArray[np.float64]]) -> Callable[..., Complexes]:
    return lambda *arguments: np.asarray(function(*map(_real, arguments)) + 0j)


def _arctan2(y: NDArray[np.float64], x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angle; none at the origin. Zeros have no sign."""
    return np.where((x == 0.0) & (y == 0.0), np.nan, np.arctan2(y + 0.0, x + 0.0))


def _extreme(pick: Callable[..., NDArray[np.float64]]) -> Callable[..., Complexes]:
    return _of_reals(lambda *values: np.asarray(pick(np.stack(values), axis=0)))


_OPERATIONS: dict[str, Callable[..., Complexes]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "^": _power,
    "minus": lambda a: -a,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "ln": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sec": lambda a: 1.0 / np.cos(a),
    "csc": lambda a: 1.0 / np.sin(a),
    "cot": lambda a: np.cos(a) / np.sin(a),
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": _of_reals(_arctan2),
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "abs": np.abs,
    "arg": lambda a: np.where(a == 0.0, np.nan, np.angle(a)),
    "conj": np.conj,
    "re": lambda a: a.real + 0j,
    "im": lambda a: a.imag + 0j,
    "min": _extreme(np.min),
    "max": _extreme(np.max),
    "rad": lambda a: a * (math.pi / 180.0),
    "deg": lambda a: a * (180.0 / math.pi),
}
