"""A body that the student turns: its orientation, and what was typed of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_sequence
from armlab.session.fields import FieldPart, Table, choice, flag, own, vector
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Json, PartType

Triple = tuple[float, float, float]
Four = tuple[float, float, float, float]

MATRIX = "body"
"""Key by which the scene knows a selection in R."""

MOST = 1e6
"""Largest number that can be typed of a quaternion, an axis or a matrix."""

ANGLES: Triple = (math.radians(40.0), math.radians(30.0), math.radians(20.0))
AXES = "zyx"
"""Angles, radians, and sequence of the body at first."""


def _first() -> Four:
    w, x, y, z = quaternion_from_rotation(rotation_from_sequence(AXES, ANGLES)).tolist()
    return w, x, y, z


def _matrix(data: Json) -> Table | None:
    """Return a typed matrix, or None."""
    if data is None:
        return None
    values = finite_floats(data, "matrix", (3, 3), "3 rows of 3 finite numbers")
    if float(abs(values).max()) > MOST:
        raise InputError(f"matrix: expected numbers up to {MOST:g}, got {float(abs(values).max()):.6g}")
    return tuple(tuple(row) for row in values.tolist())


@dataclass(frozen=True)
class Body(FieldPart):
    """A body, which does not depend on the arm.

    Attributes
    ----------
    q : (float, float, float, float)
        Its orientation as a quaternion, scalar first, of any length but zero: it is kept as it was typed.
    axis : (float, float, float)
        An axis as it was typed. It decides the sign of the angle, and is the axis while there is no rotation.
    angles : (float, float, float)
        Radians. The triple of the orientation that is nearest to these is shown.
    matrix : tuple of tuple of float, or None
        The matrix that was typed, which need not be a rotation.
    axes : str
        One of `armlab.kin.euler.SEQUENCES`.
    fixed : bool
        Whether the axes stay where they were before the first turn.
    rings : bool
        Whether the gimbal rings are drawn.
    """

    key: ClassVar[str] = "body"
    looks: ClassVar[tuple[str, ...]] = ("rings",)

    q: Four = vector("q", "quaternion of the body", _first(), -MOST, MOST)
    axis: Triple = vector("r", "axis of the rotation", (0.0, 0.0, 1.0), -MOST, MOST)
    angles: Triple = vector("φ", "angles of the body", ANGLES, -MOST_TURNED, MOST_TURNED, "rad")
    matrix: Table | None = own("matrix of the body", None, _matrix)
    axes: str = choice("sequence of axes", AXES, SEQUENCES)
    fixed: bool = flag("fixed axes", False)
    rings: bool = flag("gimbal rings", True)

    def check(self) -> None:
        """Refuse a quaternion or an axis that is zero."""
        if math.hypot(*self.q) == 0.0:
            raise InputError("q: expected a quaternion that is not zero: zero is no rotation")
        if math.hypot(*self.axis) == 0.0:
            raise InputError("r: expected an axis that is not zero: zero has no direction")


PART = PartType(Body, order=29)
