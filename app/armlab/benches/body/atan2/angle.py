"""The angle of a point by atan2 and by atan of the quotient, and which of the cases of atan2 it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

from armlab.benches.body.atan2.state import Plane
from armlab.session.state import State

SAME = 1e-12
"""Difference of two angles, radians, up to which they are equal."""

CASES = (
    (r"\mathrm{atan}\frac{y}{x}", "x > 0"),
    (r"\mathrm{atan}\frac{y}{x}+\pi", "x < 0, y ≥ 0"),
    (r"\mathrm{atan}\frac{y}{x}-\pi", "x < 0, y < 0"),
    (r"\frac{\pi}{2}", "x = 0, y > 0"),
    (r"-\frac{\pi}{2}", "x = 0, y < 0"),
    (r"\text{undefined}", "x = 0, y = 0"),
)
"""The six cases of the definition (notes 3.15): the value in LaTeX, and when it holds."""

POINTS = ((1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (-1.0, 0.0), (-1.0, -1.0), (0.0, -1.0), (1.0, -1.0))
"""A point in each quadrant and on each half of the axes, all around from the x axis."""


@dataclass(frozen=True)
class Angle:
    """The angle of a point.

    Attributes
    ----------
    x, y : float
    atan2 : float or None
        Radians in (-pi, pi]; None at the origin, where it is not defined.
    atan : float or None
        That of the quotient, in [-pi/2, pi/2]; None where x is 0, and there is no quotient.
    case : int
        Which of the `CASES` it is, 0-based.
    quadrant : int
        1 to 4, counted all around from the positive x axis; 0 on an axis.
    """

    x: float
    y: float
    atan2: float | None
    atan: float | None
    case: int
    quadrant: int

    @property
    def apart(self) -> float | None:
        """By how much atan differs from atan2, radians; None where one of them is missing."""
        return None if self.atan is None or self.atan2 is None else self.atan - self.atan2

    @property
    def right(self) -> bool:
        """Whether atan of the quotient gives the angle."""
        return self.apart is not None and abs(self.apart) < SAME


def angle_of(x: float, y: float) -> Angle:
    """Return the angle of a point.

    >>> found = angle_of(-1.0, -1.0)
    >>> round(math.degrees(found.atan2 or 0.0)), round(math.degrees(found.atan or 0.0)), found.case, found.quadrant
    (-135, 45, 2, 3)
    """
    # Zeros without a sign: of minus zero a computer's atan2 would be -pi on the negative x axis.
    x, y = x + 0.0, y + 0.0
    both = None if x == y == 0.0 else math.atan2(y, x)
    quotient = None if x == 0.0 else math.atan(y / x)
    if x > 0.0:
        case = 0
    elif x < 0.0:
        case = 1 if y >= 0.0 else 2
    else:
        case = 3 if y > 0.0 else 4 if y < 0.0 else 5
    quadrant = 0 if x * y == 0.0 else {(True, True): 1, (False, True): 2, (False, False): 3}.get((x > 0, y > 0), 4)
    return Angle(x, y, both, quotient, case, quadrant)


def present(state: State) -> Angle:
    """Return the angle of the point of the page."""
    return angle_of(*state[Plane].point)
