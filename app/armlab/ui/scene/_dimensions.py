"""Places at which the constants of the table are drawn: dimension lines for lengths, arcs for angles."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from armlab.kin.dh import common_normals
from armlab.kin.sweeps import arc
from armlab.kin.transforms import inverse
from armlab.ui.figure.anatomy import Anatomy
from armlab.ui.scene._strokes import HEAD, Floats, Segments, polyline
from armlab.ui.scene._turns import before_turn
from armlab.ui.units import Units

SMALLEST = 1e-6
"""Smallest length that is drawn, in sizes of the arm, and smallest twist, in radians."""

SHORT = 0.1
"""Length, in sizes of the arm, below which the name stands farther away, as others are near."""

ASIDE = 2.5
OVER = 0.5
"""Distance of a dimension line from the axis of its link, and how far the ticks reach beyond it, in tube radii."""

ARC_RADIUS = 3.0
NAME_AT = (1.75, 1.3)
"""Distances of the names of angles, in radii of their arcs, in turn: where links have no length, arcs share their
centre."""

STEP = math.radians(6.0)

ANGLES = ("alpha", "theta")
"""Fields that are angles."""

_TO_Z = np.array([[0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""Axes with z along x of the frame and x along its z: a twist is measured from z about x."""


@dataclass(frozen=True, eq=False)
class Dimension:
    """One constant of the table.

    Attributes
    ----------
    field : "a", "d", "alpha" or "theta"
    index : int
        Of its symbol.
    value : float
        Metres or radians.
    body : int
        On whose node it hangs.
    lines : ndarray, shape (k, 2, 3)
        In that node.
    heads : list of (tip, direction)
        Of its arrows.
    name_at : ndarray, shape (3,)
    """

    field: str
    index: int
    value: float
    body: int
    lines: Segments
    heads: list[tuple[Floats, Floats]]
    name_at: Floats

    def text(self, units: Units) -> str:
        """Return the name and the value."""
        return f"{units.symbol(self.field, self.index)} {units.constant(self.value, self.field in ANGLES)}"


def dimensions_of(anatomy: Anatomy) -> list[Dimension]:
    """Return the constants of a table that are not zero."""
    found: list[Dimension] = []
    links = common_normals(anatomy.arm.rows, anatomy.arm.convention)
    first = float(anatomy.radius[0])
    base = np.array(inverse(anatomy.root) @ anatomy.arm.base)
    found += _link(0, *links[0], 0, base, first, anatomy.size)
    for i, (body, row) in enumerate(zip(anatomy.bodies, anatomy.arm.rows, strict=True)):
        r = float(anatomy.radius[i])
        if not body.revolute and abs(row.theta) > SMALLEST:
            place = before_turn(body, row.theta)
            found.append(_angle("theta", i + 1, row.theta, i, place, ARC_RADIUS * r, HEAD * anatomy.size))
        if abs(body.d) > SMALLEST * anatomy.size:
            aside = np.array([-math.copysign(1.0, body.a) if body.a else 0.0, 0.0 if body.a else -1.0, 0.0])
            found.append(
                _distance("d", i + 1, body.d, i + 1, np.zeros(3), np.array([0.0, 0.0, 1.0]), aside, r, anatomy.size)
            )
        start = np.eye(4)
        start[2, 3] = body.d
        found += _link(i + 1, body.a, body.alpha, i + 1, start, r, anatomy.size)
    return found


def _link(index: int, a: float, alpha: float, body: int, start: Floats, r: float, size: float) -> list[Dimension]:
    """Return length and twist of the link that starts from this pose in the node of a body."""
    found = []
    if abs(a) > SMALLEST * size:
        found.append(_distance("a", index, a, body, start[:3, 3], start[:3, 0], -start[:3, 1], r, size))
    if abs(alpha) > SMALLEST:
        end = np.array(start)
        end[:3, 3] += a * start[:3, 0]
        found.append(_angle("alpha", index, alpha, body, end @ _TO_Z, ARC_RADIUS * r, HEAD * size))
    return found


def _distance(
    field: str, index: int, value: float, body: int, start: Floats, axis: Floats, aside: Floats, r: float, size: float
) -> Dimension:
    """Return a dimension line beside a length along an axis."""
    end = start + value * axis
    near, far = start + ASIDE * r * aside, end + ASIDE * r * aside
    over = OVER * r * aside
    lines = [[start, near + over], [end, far + over], [near, far]]
    fits = abs(value) > 3.0 * HEAD * size
    direction = math.copysign(1.0, value) * axis
    heads = [(near, -direction), (far, direction)] if fits else []
    return Dimension(
        field,
        index,
        value,
        body,
        np.array(lines, dtype=np.float32),
        heads,
        0.5 * (near + far) + (2.0 if abs(value) > SHORT * size else 6.0) * over,
    )


def _angle(field: str, index: int, value: float, body: int, place: Floats, radius: float, head: float) -> Dimension:
    """Return the arc of an angle about z of a place, counted from its x."""
    R, p = place[:3, :3], place[:3, 3]
    points = arc(value, radius, STEP)
    rays = [[np.zeros(3), 1.15 * points[0]], [np.zeros(3), 1.15 * points[-1]]]
    lines = np.concatenate([polyline(points), np.array(rays, dtype=np.float32)])
    back = arc(value - math.copysign(head / radius, value), radius)[-1]
    middle = arc(0.5 * value, NAME_AT[index % 2] * radius)[-1]
    heads = [(p + R @ points[-1], R @ (points[-1] - back))] if abs(value) * radius > 1.5 * head else []
    return Dimension(field, index, value, body, (lines @ R.T + p).astype(np.float32), heads, p + R @ middle)
