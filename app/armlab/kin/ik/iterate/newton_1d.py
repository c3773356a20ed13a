"""Newton's method for one equation in one unknown, with the tangent of each step."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from armlab.errors import InputError
from armlab.kin.checks import finite_floats, whole_number

SMALL = 1e-13
"""Step to the next iterate that counts as none, relative to the larger of 1 and |x|. The value of f says nothing of the
distance to the root: a function may be steep, or small everywhere."""


class Tangent(NamedTuple):
    """The line y = slope x + intercept."""

    slope: float
    intercept: float

    @property
    def root(self) -> float:
        """Intersection with y = 0, the next iterate; nan for a line along the axis."""
        return -self.intercept / self.slope if self.slope else math.nan


class Newton1D(NamedTuple):
    """One iterate: x, f(x), and the tangent there."""

    x: float
    f: float
    tangent: Tangent

    @property
    def step(self) -> float:
        """Length and direction of the step to the next iterate; nan where the tangent is level and f is not 0."""
        # The quotient keeps the last digit that the root of the tangent minus x would cost.
        if self.f == 0.0:
            return 0.0
        return -self.f / self.tangent.slope if self.tangent.slope else math.nan

    def is_root(self, tolerance: float = SMALL) -> bool:
        """Return whether f is 0 here or the step to the next iterate counts as none."""
        return abs(self.step) <= tolerance * max(1.0, abs(self.x))


@dataclass(frozen=True)
class Example1D:
    """One equation f(x) = 0 for the lesson.

    Attributes
    ----------
    key, title : str
        The title is the equation in words, with what to see.
    f, df : callable
    x0 : float
    text : str
        The function f of x as a person types it.
    """

    key: str
    title: str
    f: Callable[[float], float]
    df: Callable[[float], float]
    x0: float
    text: str


EXAMPLES = (
    Example1D(
        "root_of_two", "x² − 2 = 0: quadratic convergence", lambda x: x * x - 2.0, lambda x: 2.0 * x, 1.0, "x^2 - 2"
    ),
    Example1D(
        "one_joint",
        "cos q − 1/2 = 0: the joint of a 1R arm of unit length that puts p_x at 0.5 m",
        lambda x: math.cos(x) - 0.5,
        lambda x: -math.sin(x),
        0.5,
        "cos(x) - 1/2",
    ),
    Example1D(
        "near_flat",
        "cos q − 1/2 = 0 from beside the singularity q = 0: a small slope, a long jump",
        lambda x: math.cos(x) - 0.5,
        lambda x: -math.sin(x),
        0.02,
        "cos(x) - 1/2",
    ),
    Example1D(
        "too_far", "atan x = 0 from too far away: it diverges", math.atan, lambda x: 1.0 / (1.0 + x * x), 1.5, "atan(x)"
    ),
    Example1D(
        "cycle",
        "x³ − 2x + 2 = 0: the iterates repeat in a cycle",
        lambda x: x**3 - 2.0 * x + 2.0,
        lambda x: 3.0 * x * x - 2.0,
        0.0,
        "x^3 - 2x + 2",
    ),
)
"""Examples of section 4.4.1 of the notes: a function minus a wanted value, its derivative, and what may go wrong."""


def newton_1d(
    f: Callable[[float], float], df: Callable[[float], float], x0: float, *, tolerance: float = SMALL, most: int = 20
) -> list[Newton1D]:
    """Iterate x_(n+1) = x_n - f(x_n) / f'(x_n) and return each iterate with its tangent.

    It ends at a root, or where the tangent is level, a number is not finite, or after ``most`` steps;
    the last iterate is always the last of the list.

    Parameters
    ----------
    f, df : callable
        Function and derivative.
    x0 : float
    tolerance : float
        As of `Newton1D.is_root`.
    most : int

    Raises
    ------
    InputError
        ``x0`` is not finite, or the function is not at ``x0``.

    References
    ----------
    Notes 4.106-4.110. Equation 4.110 prints x_(n+1) = f / f'; x_n minus it is right, as in 4.107 and 4.109.

    Examples
    --------
    >>> [round(step.x, 6) for step in newton_1d(lambda x: x * x - 2, lambda x: 2 * x, 1.0, most=3)]
    [1.0, 1.5, 1.416667, 1.414216]
    """
    x = float(finite_floats(x0, "x0", (), "a finite number"))
    found: list[Newton1D] = []
    for _ in range(whole_number(most, "most", 0) + 1):
        point = _point(f, df, x)
        if point is None:
            break
        found.append(point)
        if point.is_root(tolerance) or point.tangent.slope == 0.0:
            break
        x = x + point.step
        if not math.isfinite(x):
            break
    if not found:
        raise InputError(f"f: expected a function with a finite value and slope at x0 = {x0}")
    return found


def _point(f: Callable[[float], float], df: Callable[[float], float], x: float) -> Newton1D | None:
    """Return the iterate at x; None when the function or its slope is not finite."""
    try:
        value, slope = float(f(x)), float(df(x))
    except (OverflowError, ValueError, ZeroDivisionError):
        return None
    if not (math.isfinite(value) and math.isfinite(slope)):
        return None
    return Newton1D(x, value, Tangent(slope, value - slope * x))
