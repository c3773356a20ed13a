"""The arc of a circle through three points, or the whole circle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType

Floats = NDArray[np.float64]

IN_LINE = 1e-9
"""Sine of the angle of the chords below which three points are on a line: the radius would have no digits."""

LARGEST_RADIUS = 1000.0
"""Largest radius, relative to the longest chord: a larger circle looks straight and depends on the last digit typed."""


class Arc(Path):
    """A part of a circle, at constant rate in s.

    Attributes
    ----------
    centre, x, y : ndarray, shape (m,)
        The circle is centre + radius (x cos + y sin); x points to the first waypoint.
    radius : float
    angle : float
        Turned from s = 0 to 1, radians.
    """

    def __init__(self, centre: Floats, x: Floats, y: Floats, radius: float, angle: float) -> None:
        self.centre, self.x, self.y, self.radius, self.angle = centre, x, y, radius, angle
        self.m, self.pieces = len(centre), np.zeros(0)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        turned = self.angle * s
        c, sine = np.cos(turned)[..., None], np.sin(turned)[..., None]
        # Each derivative turns the radius by a quarter and stretches it by the angle.
        turns = ((self.x, self.y), (self.y, -self.x), (-self.x, -self.y), (-self.y, self.x))
        found = []
        for order in orders:
            x, y = turns[order]
            values = self.radius * self.angle**order * (c * x + sine * y)
            found.append(values + self.centre if order == 0 else values)
        return found


def make(knots: Floats, options: dict[str, Any]) -> Arc:
    """Return the arc from waypoint 1 through 2 to 3; or the circle from 1 through 2 and 3 back to 1.

    The centre is p1 + alpha a + beta b with the chords a = p2 - p1 and b = p3 - p1, from its equal distances; so it
    works in any number of coordinates.

    References
    ----------
    Notes, end of section 6.3.2 (named there, without formulas).

    Raises
    ------
    InputError
        No one circle goes through the three, or one of more than `LARGEST_RADIUS` times their distance.
    """
    a, b = knots[1] - knots[0], knots[2] - knots[0]
    gram = np.array([[a @ a, a @ b], [a @ b, b @ b]])
    if gram[1, 1] <= (IN_LINE**2) * gram[0, 0]:
        raise InputError("waypoint 3: the same as waypoint 1; infinitely many circles go through two points")
    if np.linalg.det(gram) <= (IN_LINE**2) * gram[0, 0] * gram[1, 1]:
        raise InputError("waypoint 3: the three points are on a straight line; move one, or take a line")
    alpha, beta = np.linalg.solve(gram, 0.5 * np.diag(gram))
    centre = knots[0] + alpha * a + beta * b
    spokes = knots - centre
    radius = float(np.linalg.norm(spokes[0]))
    _refuse_huge(radius, knots)
    x = spokes[0] / radius
    beside = spokes[1:] - (spokes[1:] @ x)[:, None] * x
    lengths = np.linalg.norm(beside, axis=1)
    y = beside[np.argmax(lengths)] / lengths.max()
    second, third = (math.atan2(p @ y, p @ x) % (2.0 * math.pi) for p in spokes[1:])
    if third < second:
        y, third = -y, 2.0 * math.pi - third
    return Arc(centre, x, y, radius, 2.0 * math.pi if options["full"] else third)


def _refuse_huge(radius: float, knots: Floats) -> None:
    chord = float(np.linalg.norm(knots - np.roll(knots, 1, axis=0), axis=1).max())
    if radius > LARGEST_RADIUS * chord:
        raise InputError(
            f"waypoint 3: the three points are almost on a straight line, their circle would be {radius / chord:.0f} "
            "times as large as they are apart; move one, or take a line"
        )


PATH = PathType(
    "circle",
    "Circle through three points",
    3,
    make,
    least=3,
    most=3,
    spaces=("cartesian",),
    fields=(Field("full", "", "the whole circle, back to the first point", "flag", False),),
    formula=r"X(s)=c+r\,(u\cos\alpha s+v\sin\alpha s)",
    says="Centre c and radius r from the three knots; u, v span their plane.",
)
