"""Lines in space and the common normal of two of them, which defines the Denavit-Hartenberg parameters a and alpha."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats, wrong

Vector = NDArray[np.float64]
Relation = Literal["skew", "parallel", "intersecting", "coincident"]

PARALLEL_ANGLE = 1e-9
"""Angle, in radians, below which two lines count as parallel: the feet of the normal would be anywhere within 1e9 times
the distance of the lines, which a table written with ten decimals does not mean."""

RELATIVE_LENGTH = 1e-9
"""Distance, as a fraction of the scale in metres that the caller gives, below which two lines meet."""

UNIT = 1e-15
"""Deviation of the length of a direction from one up to which it is not normalised again."""

FREE: dict[Relation, str] = {
    "skew": "Exactly one segment is perpendicular to both lines: its place is unique; only the direction of x is free.",
    "parallel": "The lines are parallel: the normal may sit anywhere along them, so its foot (the offset d) is free.",
    "intersecting": "The lines meet: the normal has length zero and is perpendicular to both; only its sense is free.",
    "coincident": "Both are the same line: the foot and the direction of the normal, perpendicular to it, are free.",
}
"""Sentences on what may be chosen in each case (notes, the list after 4.16)."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line with a sense: point + t direction. Notes 4.8-4.9.

    Parameters
    ----------
    point : ndarray, shape (3,)
        Any point of it, metres.
    direction : ndarray, shape (3,)
        Any length but zero; kept as a unit vector. In the same axes as the point.

    Raises
    ------
    InputError
        Not three finite numbers, or a direction of length zero.
    """

    point: Vector
    direction: Vector

    def __post_init__(self) -> None:
        point = finite_floats(self.point, "point", (3,), "three finite numbers, metres")
        direction = finite_floats(self.direction, "direction", (3,), "three finite numbers")
        largest = float(np.abs(direction).max())
        if largest == 0.0:
            raise InputError("direction: expected a vector that is not zero, got [0, 0, 0]")
        if largest > 1.0 or abs(float(np.linalg.norm(direction)) - 1.0) > UNIT:  # what is of length one stays as it is
            # Scaled first: the squares of very small or very large components leave the range of floats.
            direction /= largest
            direction /= np.linalg.norm(direction)
        for name, value in (("point", point), ("direction", direction)):
            value.setflags(write=False)
            object.__setattr__(self, name, value)


@dataclass(frozen=True, eq=False)
class CommonNormal:
    """The segment perpendicular to two lines, from the first to the second. Notes, definitions 6 and 7.

    Parameters
    ----------
    kind : "skew", "parallel", "intersecting" or "coincident"
        Relation of the lines. Coincident lines are parallel ones with distance zero.
    foot1, foot2 : ndarray, shape (3,)
        Ends of the segment, on the first and the second line, metres. For parallel lines foot1 is the point of the
        first one.
    a : float
        Length in metres, not negative; exactly 0 for intersecting and coincident lines.
    alpha : float
        Twist: the angle about ``normal`` from the first direction to the second, in (-pi, pi]. In (0, pi) for
        intersecting lines, exactly 0 or pi for parallel and coincident ones.
    normal : ndarray, shape (3,)
        Unit vector: from the first line to the second; z1 x z2 for intersecting lines; for coincident ones the
        projection of the coordinate axis that is farthest from their direction, the first of equals.

    With x along ``normal`` and z along the first line, Tx(a) Rx(alpha) carries the frame at foot1 to the one at foot2
    whose z is along the second line (notes 4.10-4.13).
    """

    kind: Relation
    foot1: Vector
    foot2: Vector
    a: float
    alpha: float
    normal: Vector

    @property
    def free(self) -> str:
        """A sentence on what may be chosen."""
        return FREE[self.kind]


def common_normal(
    first: Line,
    second: Line,
    *,
    scale: float = 1.0,
    angle_tolerance: float = PARALLEL_ANGLE,
    length_tolerance: float = RELATIVE_LENGTH,
) -> CommonNormal:
    """Return the common normal of two lines.

    The direction z1 x z2 of almost parallel lines is taken from their difference, which is exact in floats, so that it
    keeps its digits, and the position along the lines is divided by the sine once, not by its square.

    Parameters
    ----------
    first, second : Line
        Lines in the same axes.
    scale : float
        A length of the scene in metres, such as an arm's reach: what ``length_tolerance`` is relative to.
    angle_tolerance : float
        Radians; lines nearer than this to parallel count as parallel.
    length_tolerance : float
        Without unit; lines nearer than this times ``scale`` meet.

    Raises
    ------
    InputError
        The scale is not a positive number.

    References
    ----------
    Notes, definitions 6 and 7 and equations 4.8-4.9.

    Examples
    --------
    >>> found = common_normal(Line([0, 0, 0], [0, 0, 1]), Line([1, 0, 2], [0, 1, 0]))
    >>> found.kind, found.a, round(found.alpha, 4), found.foot1.tolist()
    ('skew', 1.0, -1.5708, [0.0, 0.0, 2.0])
    """
    if not (math.isfinite(scale) and scale > 0.0):
        raise wrong("scale", "a positive number of metres", scale)
    z1, z2 = first.direction, second.direction
    sense = 1.0 if float(z1 @ z2) >= 0.0 else -1.0
    cross = sense * np.cross(z1, sense * z2 - z1)
    sine = float(np.linalg.norm(cross))
    # The point of the second line nearest to the first one's point: nothing below depends on how far apart they were.
    between = second.point - first.point
    between = between - (between @ z2) * z2
    shortest = length_tolerance * scale
    if sine < angle_tolerance:
        return _of_parallel(first, between, 0.0 if sense > 0.0 else math.pi, shortest)
    normal = cross / sine
    foot1 = first.point + (np.cross(between, z2) @ normal / sine) * z1
    foot2 = first.point + between + (np.cross(between, z1) @ normal / sine) * z2
    distance = float(between @ normal)
    alpha = math.atan2(sine, float(z1 @ z2))
    if abs(distance) <= shortest:
        return CommonNormal("intersecting", foot1, foot2, 0.0, alpha, normal)
    if distance < 0.0:
        distance, alpha, normal = -distance, -alpha, -normal
    return CommonNormal("skew", foot1, foot2, distance, alpha, normal)


def _of_parallel(first: Line, between: Vector, alpha: float, shortest: float) -> CommonNormal:
    """Return the normal through the first line's point; ``between`` goes from there to the second line."""
    foot1, foot2 = np.array(first.point), first.point + between
    a = float(np.linalg.norm(between))
    if a > shortest:
        return CommonNormal("parallel", foot1, foot2, a, alpha, between / a)
    z = first.direction
    axis = np.eye(3)[int(np.argmin(np.abs(z)))]
    normal = axis - (axis @ z) * z
    return CommonNormal("coincident", foot1, foot2, 0.0, alpha, normal / np.linalg.norm(normal))
