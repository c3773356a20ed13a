"""The clothoid (Euler spiral): its curvature grows in proportion to the arc length."""

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

MOST_TURN = 20.0 * math.pi


class Clothoid(Path):
    """A spiral in a plane from a point, straight at first; s is the distance gone over its length.

    Attributes
    ----------
    start, x, y : ndarray, shape (m,)
        First waypoint; directions along the chord and across it.
    turn : float
        Heading at the end minus heading at the start, radians; the heading is turn s^2.
    length : float
        Arc length; the curvature is 2 turn s / length.
    """

    def __init__(self, start: Floats, x: Floats, y: Floats, chord: float, turn: float) -> None:
        self.start, self.x, self.y, self.turn = start, x, y, turn
        self.m, self.pieces = len(start), np.zeros(0)
        self._factor = chord / complex(self._spiral(np.array(1.0)))
        self.length = abs(self._factor)

    def _spiral(self, s: Floats) -> NDArray[np.complex128]:
        """Return the integral of exp(i turn r^2) from 0 to s."""
        # Only here: a tenth of a second at the start of the lab.
        from scipy.special import fresnel  # type: ignore[import-untyped]

        root = math.sqrt(2.0 * abs(self.turn) / math.pi)
        sine, cosine = fresnel(root * s)
        return np.asarray((cosine + 1j * math.copysign(1.0, self.turn) * sine) / root)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        heading = np.exp(1j * self.turn * s * s)
        slope = 2j * self.turn * s
        found = []
        for order in orders:
            if order == 0:
                values = self._spiral(s)
            else:
                values = heading * (1.0, slope, 2j * self.turn + slope * slope)[order - 1]
            placed = self._factor * values
            flat = placed.real[..., None] * self.x + placed.imag[..., None] * self.y
            found.append(flat + self.start if order == 0 else flat)
        return found


def make(knots: Floats, options: dict[str, Any]) -> Clothoid:
    """Return the spiral from waypoint 1 to 2.

    References
    ----------
    Named in the notes, section 6.2. Fresnel's integrals: Abramowitz and Stegun, chapter 7.3.
    """
    turn: float = options["turn"]
    if turn == 0.0:
        raise InputError("turn: expected an angle that is not 0 (that is the straight line), got 0")
    chord = knots[1] - knots[0]
    length = float(np.linalg.norm(chord))
    x = chord / length
    if len(x) == 2:
        if options["normal"] is not None:
            raise InputError("normal: a way in the plane has none; leave it out")
        y = np.array([-x[1], x[0]])
    else:
        y = np.cross(across(x, options["normal"], "normal"), x)
    return Clothoid(knots[0], x, y, length, turn)


PATH = PathType(
    "clothoid",
    "Clothoid",
    15,
    make,
    least=2,
    most=2,
    spaces=("cartesian",),
    fields=(
        Field("turn", "θ", "change of heading", "number", math.pi / 2, low=-MOST_TURN, high=MOST_TURN, unit="rad"),
        Field("normal", "n", "normal of its plane; left out: z", "vector"),
    ),
    dimensions=(2, 3),
    formula=r"\kappa(s)=\kappa_0+\kappa_1s",
    says="The curvature grows evenly with the length.",
)
