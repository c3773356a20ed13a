"""The helix: a circle that advances along its axis."""

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
from armlab.kin.paths._plane import across

Floats = NDArray[np.float64]


class Helix(Path):
    """Whole turns from one point to another, at constant rate.

    Attributes
    ----------
    start : ndarray, shape (3,)
        First waypoint.
    advance : ndarray, shape (3,)
        Displacement from the first to the last waypoint, along the axis.
    x, y : ndarray, shape (3,)
        Vector from the axis to the first waypoint, and initial direction around the axis.
    radius, angle : float
        Metres; radians turned from s = 0 to 1.
    """

    def __init__(self, start: Floats, advance: Floats, x: Floats, y: Floats, radius: float, angle: float) -> None:
        self.start, self.advance, self.x, self.y, self.radius, self.angle = start, advance, x, y, radius, angle
        self.m, self.pieces = 3, np.zeros(0)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        c, sine = np.cos(self.angle * s)[..., None], np.sin(self.angle * s)[..., None]
        turns = ((self.x, self.y), (self.y, -self.x), (-self.x, -self.y), (-self.y, self.x))
        found = []
        for order in orders:
            x, y = turns[order]
            values = self.radius * self.angle**order * (c * x + sine * y)
            if order == 0:
                values = values + (self.start - self.radius * self.x) + s[..., None] * self.advance
            found.append(values + self.advance if order == 1 else values)
        return found


def make(knots: Floats, options: dict[str, Any]) -> Helix:
    """Return the helix from waypoint 1 to 2.

    Curvature r / (r^2 + h^2) and torsion h / (r^2 + h^2) are constant, with h the advance per radian; right-handed with
    positive ``turns``.

    References
    ----------
    Notes 6.140-6.141 applied to (r cos a, r sin a, h a).
    """
    turns = options["turns"]
    if turns == 0.0 or turns != round(turns):
        raise InputError(f"turns: expected a whole number that is not 0, so that it ends in waypoint 2; got {turns:g}")
    advance = knots[1] - knots[0]
    axis = advance / np.linalg.norm(advance)
    x = across(axis, options["side"], "side")
    return Helix(knots[0], advance, x, np.cross(axis, x), options["radius"], 2.0 * math.pi * turns)


PATH = PathType(
    "helix",
    "Helix",
    16,
    make,
    least=2,
    most=2,
    spaces=("cartesian",),
    fields=(
        Field("radius", "r", "radius", "number", 0.1, low=0.0, above=True, unit="q"),
        Field("turns", "N", "whole turns; negative: left-handed", "number", 2.0, low=-100.0, high=100.0),
        Field("side", "", "from the axis to the first point; left out: upwards", "vector"),
    ),
    dimensions=(3,),
    formula=r"X(s)=c+r\,(u\cos\alpha s+v\sin\alpha s)+h\,s\,w",
    says="A circle that advances along w.",
)
