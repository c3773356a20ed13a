"""Newton's method for one equation on its page: the iterates, and a sentence on the end."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache

from armlab.benches.iterate.runs.slopes import EULER, slope_at
from armlab.content.expressions import Expression, parse
from armlab.content.quantities import with_decimal_points
from armlab.errors import InputError
from armlab.kin.ik.iterate import EXAMPLES, Example1D, newton_1d
from armlab.kin.ik.iterate.newton_1d import SMALL
from armlab.kin.ik.iterate.newton_1d import Newton1D as Iterate1D
from armlab.session.amounts import signed

MOST = 20
"""Largest number of steps."""

WIDTHS = (SMALL, 1e-12, 1e-11, 1e-10)
"""Distances from an iterate, relative to the larger of 1 and |x|, in which a root is looked for: the least is free of
another root close by, and the largest, in the last digit that is shown, of the rounding of f."""

LARGE = 1e6
"""Growth of |x| beyond which the iterates diverge."""

LONGEST_ROUND = 4
ROUND = 1e-7
"""Length of the longest cycle that is looked for, and difference, relative to |x|, up to which it closes."""

UNKNOWN, JOINT = "x", "q"
"""Name of the unknown in typed functions, and the one it has in the examples of a joint, which may be typed as well."""

Function = Callable[[float], float]


@dataclass(frozen=True)
class Solved:
    """An iteration.

    Attributes
    ----------
    iterates : tuple
        Each with its tangent.
    status : str
        ``"converged"``, ``"level"``, ``"round"``, ``"away"``, ``"undefined"`` or ``"most"``.
    says : str
    f : callable
    """

    iterates: tuple[Iterate1D, ...]
    status: str
    says: str
    f: Function

    @property
    def last(self) -> int:
        """Number of the last iterate."""
        return len(self.iterates) - 1


def example_named(key: str) -> Example1D:
    """Return an example by key; `InputError` if there is none."""
    for example in EXAMPLES:
        if example.key == key:
            return example
    raise InputError(f"equation: unknown name {key!r}. Available: {', '.join(each.key for each in EXAMPLES)}")


def typed_function(text: str) -> Function:
    """Return the typed function of x, which may be called q; `InputError` if it cannot be read."""
    expression = _read(text)
    return _where_defined(lambda x: expression.value({UNKNOWN: x, JOINT: x, EULER: math.e}))


def typed_slope(text: str) -> Function:
    """Return the derivative of the typed function of x; `InputError` if it cannot be read."""
    expression = _read(text)
    return _where_defined(lambda x: slope_at(expression, x))


def _read(text: str) -> Expression:
    try:
        return _read_in(text, UNKNOWN)
    except InputError as refusal:
        with suppress(InputError):
            return _read_in(text, JOINT)
        raise InputError(f"f(x): {refusal}") from None


def _read_in(text: str, unknown: str) -> Expression:
    return parse(with_decimal_points(text), (unknown, EULER))


def _where_defined(f: Function) -> Function:
    """Return a function that is not a number where a formula has no value, as a root of a negative number."""

    def defined(x: float) -> float:
        try:
            return f(x)
        except (ValueError, ZeroDivisionError, OverflowError):
            # The iteration ends there.
            return math.nan

    return defined


@lru_cache(maxsize=64)
def solved(key: str, text: str, x0: float) -> Solved:
    """Return the iteration for an example, or for a typed function if there is one.

    Raises
    ------
    InputError
        The function cannot be read, or has no finite value and slope at x0.
    """
    if text:
        f, df = typed_function(text), typed_slope(text)
    else:
        example = example_named(key)
        # By its rules the slope is 0 where it is, as at q = pi, and not what the sine of a rounded pi is.
        f, df = example.f, typed_slope(example.text)
    try:
        found = tuple(newton_1d(f, df, x0, most=MOST))
        if not _crosses(f, found[-1]):
            found = tuple(newton_1d(f, df, x0, tolerance=0.0, most=MOST))
    except InputError:
        raise InputError(f"x₀ = {x0:g}: f has no finite value or slope there") from None
    status, says = _why(found, f)
    return Solved(found, status, says, f)


def _why(found: Sequence[Iterate1D], f: Function) -> tuple[str, str]:
    last, k = found[-1], len(found) - 1
    steps = "1 step" if k == 1 else f"{k} steps"
    if last.is_root() and _crosses(f, last):
        return "converged", f"converged to x = {signed(last.x, 10)} in {steps}" if k else "x₀ is a root already"
    if abs(last.x) > LARGE * max(1.0, abs(found[0].x)):
        return "away", f"diverged: the iterates move farther and farther away, x{_index(k)} = {signed(last.x, 3)}"
    if last.tangent.slope == 0.0:
        return "level", f"f′(x{_index(k)}) = 0: the tangent is horizontal and meets the axis nowhere: no next x"
    if k < MOST:
        there = signed(last.tangent.root, 4)
        return "undefined", f"the tangent at x{_index(k)} meets the axis at {there}, where f has no value"
    return _unfinished([each.x for each in found], [abs(each.f) for each in found], last.f)


def _unfinished(x: Sequence[float], f: Sequence[float], last: float) -> tuple[str, str]:
    """Return why the largest number of steps was not enough."""
    for period in range(1, LONGEST_ROUND + 1):
        if abs(x[-1] - x[-1 - period]) <= ROUND * max(1.0, abs(x[-1])):
            if period == 1:
                break
            places = ", ".join(signed(round(value, 6), 6) for value in x[-period:])
            return "round", f"the iterates repeat in a cycle: {places}, and so on; f is 0 at none of them"
    if f[-1] < 0.6 * f[-2] < 0.36 * f[-3]:
        return "most", f"no root after {MOST} steps, but still converging: f = {signed(last, 2)}"
    return "most", f"no root after {MOST} steps, and not converging: f = {signed(last, 3)}"


def _crosses(f: Function, last: Iterate1D) -> bool:
    """Return whether f is 0 at an iterate, or has both signs beside it, within what can be told of x.

    Far out a step that counts as none is longer than the waves of a sine, and leads to no root.
    """

    def both_signs(near: float) -> bool:
        low, high = sorted((f(last.x - near), f(last.x + near)))
        return low <= 0.0 <= high

    return last.f == 0.0 or any(both_signs(width * max(1.0, abs(last.x))) for width in WIDTHS)


def _index(k: int) -> str:
    return str(k).translate(_LOWERED)


_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
