"""Formulas of matrices worked out: sums, products, transposes, inverses and powers, with sentences on sizes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.expressions import Expression
from armlab.errors import InputError

Value = NDArray[np.float64] | float
"""A matrix, or a number; a matrix of one row and one column becomes a number."""

TRANSPOSE = "T"
"""Name that stands after ``^`` for the transposed matrix, unless it is the name of a matrix."""

INVERTIBLE = 1e12
"""Largest condition number of a matrix that is inverted."""

LARGEST_POWER = 20


class _Marker(float):
    """The T of a transpose, while a formula is worked out."""


def shape_of(value: Value) -> tuple[int, ...]:
    """Return rows and columns; nothing of a number."""
    return np.shape(value)


@dataclass(frozen=True)
class Algebra:
    """The fold of formulas of matrices, with values for their names.

    Attributes
    ----------
    values : mapping of str to ndarray or float
    """

    values: Mapping[str, Value]

    def value(self, formula: Expression) -> Value:
        """Return the value of a formula.

        Raises
        ------
        InputError
            Sizes that do not fit, a matrix without an inverse, an operation that matrices do not have.
        """
        with np.errstate(all="ignore"):  # what is not finite is said by whoever asks
            found = formula.folded(self)
        if isinstance(found, _Marker):
            raise _alone()
        return found

    def number(self, value: float) -> Value:
        """Return the number itself."""
        return value

    def name(self, name: str) -> Value:
        """Return the matrix or number of a name, or the mark of a transpose."""
        return self.values[name] if name in self.values else _Marker()

    def operation(self, operation: str, arguments: Sequence[Value]) -> Value:
        """Return the sum, product, power or root, the transpose or the negative of the arguments."""
        return _operate(operation, arguments)


def _alone() -> InputError:
    return InputError("T transposes and stands behind ^, as in J^T")


def _operate(operation: str, arguments: Sequence[Value]) -> Value:
    first, *rest = arguments
    if operation == "^" and isinstance(rest[0], _Marker) and not isinstance(first, _Marker):
        return _plain(np.transpose(first))
    if any(isinstance(each, _Marker) for each in arguments):
        raise _alone()
    if operation == "minus":
        return -first
    if operation == "sqrt":
        return _root(first)
    return {"+": _sum, "-": _difference, "*": _product, "/": _quotient, "^": _power}[operation](first, rest[0])


def _plain(value: Value) -> Value:
    """Return a matrix of one entry as a number."""
    return float(np.asarray(value).item()) if np.size(value) == 1 else value


def _said(value: Value) -> str:
    shape = shape_of(value)
    return f"{shape[0]} × {shape[1]}" if shape else "a number"


def _sum(a: Value, b: Value) -> Value:
    if shape_of(a) != shape_of(b):
        raise InputError(f"a sum needs two of the same size, got {_said(a)} and {_said(b)}")
    return _plain(np.add(a, b))


def _difference(a: Value, b: Value) -> Value:
    return _sum(a, -b)


def _product(a: Value, b: Value) -> Value:
    shapes = shape_of(a), shape_of(b)
    if all(shapes) and shapes[0][1] != shapes[1][0]:
        raise InputError(
            f"the sizes of a product do not fit: {_said(a)} times {_said(b)}; the first is to have as many columns as "
            "the second has rows"
        )
    return _plain(np.matmul(a, b) if all(shapes) else np.multiply(a, b))


def _quotient(a: Value, b: Value) -> Value:
    if shape_of(b):
        raise InputError("matrices cannot be divided by; type an inverse as (...)^-1")
    if b == 0.0:
        raise InputError("division by zero")
    return _plain(np.divide(a, b))


def _power(a: Value, b: Value) -> Value:
    if shape_of(b):
        raise InputError(f"expected a number, -1 or T behind ^, got {_said(b)}")
    if not shape_of(a):
        return _of_number(float(a), float(b))
    rows, columns = shape_of(a)
    if rows != columns:
        raise InputError(f"only a square matrix has powers and an inverse, got {_said(a)}")
    if not -1 <= b <= LARGEST_POWER or b != int(b):
        raise InputError(f"expected -1 or a whole number up to {LARGEST_POWER} behind ^, got {float(b):g}")
    whole = int(b)
    if whole == -1 and np.linalg.cond(a) > INVERTIBLE:
        raise InputError(f"a {_said(a)} matrix in the formula has no inverse: its rank is {np.linalg.matrix_rank(a)}")
    return _plain(np.linalg.matrix_power(a, whole))


def _of_number(a: float, b: float) -> float:
    try:
        found = a**b
    except (ZeroDivisionError, OverflowError):
        raise InputError(f"{a:g}^{b:g} has no value") from None
    if isinstance(found, complex):
        raise InputError("not a real number, such as the root of a negative one")
    return float(found)


def _root(a: Value) -> Value:
    if shape_of(a):
        raise InputError(f"expected a number in sqrt, got {_said(a)}")
    if float(a) < 0.0:
        raise InputError("not a real number: the root of a negative one")
    return float(np.sqrt(a))
