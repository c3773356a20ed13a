"""Slopes of formulas in one variable: the derivative at a point, by the rules of differentiation."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from armlab.content.expressions import OPERATIONS, Expression

ROUNDING = 1e-15
"""Slope that counts as 0, relative to the terms of which it is the sum: less is left where these cancel."""


EULER = "e"
"""Name of Euler's number."""


class Slope(NamedTuple):
    """A part of a formula at a point: its value, its slope, and the sum of the sizes of the terms of the slope."""

    value: float
    slope: float
    size: float


def slope_at(expression: Expression, x: float) -> float:
    """Return the derivative of a formula at x, exactly 0 where it is zero but for rounding.

    At a corner, as that of abs at 0, it is the mean of the slopes on both sides, or one of them.

    Parameters
    ----------
    expression : Expression
        Of one variable, e and the functions of `armlab.content.expressions.FUNCTIONS`.
    x : float

    Raises
    ------
    ValueError, ZeroDivisionError, OverflowError
        The formula has no value or no finite slope there.

    Examples
    --------
    >>> from armlab.content.expressions import parse
    >>> slope_at(parse("x^3 - 12x", ["x"]), 3.0), slope_at(parse("x^3 - 0.03x", ["x"]), 0.1)
    (15.0, 0.0)
    """
    found = expression.folded(_Slopes(x))
    return 0.0 if abs(found.slope) <= ROUNDING * found.size else found.slope


class _Slopes:
    """The fold to the slopes at a point."""

    def __init__(self, x: float) -> None:
        self._x = x

    def number(self, value: float) -> Slope:
        return Slope(value, 0.0, 0.0)

    def name(self, name: str) -> Slope:
        return Slope(math.e, 0.0, 0.0) if name == EULER else Slope(self._x, 1.0, 1.0)

    def operation(self, operation: str, arguments: list[Slope]) -> Slope:
        values = [each.value for each in arguments]
        # An argument that does not move asks for no derivative, which may not exist: 0^2, or x^2 for x < 0.
        partials = [_partial(operation, values, k) if each.size else (0.0, 0.0) for k, each in enumerate(arguments)]
        slope = sum(partial * each.slope for (partial, _), each in zip(partials, arguments, strict=True))
        size = sum(most * each.size for (_, most), each in zip(partials, arguments, strict=True))
        return Slope(float(OPERATIONS[operation](*values)), slope, size)


def _partial(operation: str, values: list[float], k: int) -> tuple[float, float]:
    """Return the derivative of an operation by its k-th argument, and the size to which its rounding is relative."""
    if operation in ("min", "max"):
        found = float(values.index(OPERATIONS[operation](*values)) == k)
        return found, found
    if operation in ("sin", "cos"):
        return _DERIVATIVES[operation][k](*values), 1.0
    found = _DERIVATIVES[operation][k](*values)
    return found, abs(found)


_DERIVATIVES: dict[str, tuple[Callable[..., float], ...]] = {
    "+": (lambda a, b: 1.0, lambda a, b: 1.0),
    "-": (lambda a, b: 1.0, lambda a, b: -1.0),
    "*": (lambda a, b: b, lambda a, b: a),
    "/": (lambda a, b: 1.0 / b, lambda a, b: -a / b / b),
    "^": (
        lambda a, b: b * OPERATIONS["^"](a, b - 1.0) if b else 0.0,
        lambda a, b: OPERATIONS["^"](a, b) * math.log(a),
    ),
    "minus": (lambda a: -1.0,),
    "sqrt": (lambda a: 0.5 / math.sqrt(a),),
    "exp": (math.exp,),
    "ln": (lambda a: 1.0 / a,),
    "sin": (math.cos,),
    "cos": (lambda a: -math.sin(a),),
    "tan": (lambda a: 1.0 / math.cos(a) ** 2,),
    "asin": (lambda a: 1.0 / math.sqrt(1.0 - a * a),),
    "acos": (lambda a: -1.0 / math.sqrt(1.0 - a * a),),
    "atan": (lambda a: 1.0 / (1.0 + a * a),),
    "atan2": (lambda y, x: x / (x * x + y * y), lambda y, x: -y / (x * x + y * y)),
    "abs": (lambda a: math.copysign(1.0, a) if a else 0.0,),
    "rad": (lambda a: math.radians(1.0),),
    "deg": (lambda a: math.degrees(1.0),),
}
"""Derivatives of the operations by each of their arguments."""
