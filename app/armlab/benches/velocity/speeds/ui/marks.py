"""Velocities as arrows in the world: parts put tip to tail, two points of a link, and the selection in J."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.speeds.motion import Moving, TwoPoints
from armlab.benches.velocity.speeds.state import drawn_scales
from armlab.kin.arm import Arm
from armlab.session.parts.selection import Selection
from armlab.ui.colours import AXES, GREEN, GREY, VERMILLION, Rgb, joint_colour
from armlab.ui.format import number, subscript
from armlab.ui.scene._marks import Marks, Segment
from armlab.ui.units import Units

Floats = NDArray[np.float64]

LEAST = 2e-3
"""Length of the shortest arrow that is drawn, in sizes of the arm."""

UNIT = 0.24
"""Length of a highlighted joint axis, in sizes of the arm."""

REACHED = 0.45
"""Half length of the line of a joint axis, in sizes of the arm."""

COLOURS: tuple[Rgb, ...] = tuple(AXES[axis] for axis in "xyz")


@dataclass(frozen=True)
class Look:
    """Settings for arrows: size of the arm, metres for 1 m/s and for 1 rad/s, units, and the colour of plain lines."""

    size: float
    scales: tuple[float, float]
    units: Units
    ink: Rgb


def parts_marks(moving: Moving, look: Look, rows: slice) -> Marks:
    """Return the parts of the joints, tip to tail from the tool on: of v (rows 0 to 2) or of omega (3 to 5)."""
    scale = look.scales[0 if rows.start == 0 else 1]
    arrows: list[Segment] = []
    corner = moving.point
    for j, part in enumerate(moving.parts[rows].T):
        reached = corner + scale * part
        arrows.append((corner, reached, joint_colour(j)))
        corner = reached
    return Marks(_long(arrows, look))


def sum_marks(moving: Moving, look: Look, rows: slice) -> Marks:
    """Return v or omega of the tool, with its size."""
    turning = rows.start != 0
    total = moving.twist[rows]
    end = moving.point + look.scales[1 if turning else 0] * total
    arrows = _long([(moving.point, end, look.ink)], look)
    size = float(np.linalg.norm(total))
    name = f"ω {look.units.text(size, True)}" if turning else f"v {look.units.text(size, False)}"
    unit = look.units.angle_unit if turning else look.units.length_unit
    return Marks(arrows, label=f"{name} {unit}/s" if arrows else "", at=end)


def point_marks(points: TwoPoints, look: Look) -> tuple[Marks, Marks]:
    """Return v1 with the line between the points, and v2 as the sum of v1 and omega x r12."""
    scale, units = look.scales[0], look.units
    first, second = points.first + scale * points.v1, points.second + scale * points.v2
    middle = points.second + scale * points.v1
    turned = points.first + look.scales[1] * points.omega
    one = Marks(
        _long([(points.first, first, GREEN), (points.first, turned, look.ink)], look),
        [(points.first, points.second, GREY)],
        f"1: v₁ {units.text(float(np.linalg.norm(points.v1)), False)} {units.length_unit}/s",
        first,
    )
    parts: list[Segment] = [(points.second, middle, GREY), (middle, second, VERMILLION), (points.second, second, GREEN)]
    other = Marks(
        _long(parts, look),
        label=f"2: v₂ {units.text(float(np.linalg.norm(points.v2)), False)} {units.length_unit}/s",
        at=second,
    )
    return one, other


def selected_marks(arm: Arm, moving: Moving, selected: Selection, look: Look) -> Marks:
    """Return the marks in the world of a selected entry, row or column of J."""
    row, column = selected.row, selected.column
    if not selected.matrix or (row is None and column is None):
        return Marks()
    if row is None and column is not None:
        return _column(arm, moving, column, look)
    if column is None and row is not None:
        return _row(arm, moving, row, look)
    assert row is not None
    assert column is not None
    return _entry(arm, moving, row, column, look)


def unit_scale(arm: Arm) -> float:
    """Return the metres on screen for 1 m/s of a joint with speed 1."""
    return drawn_scales(arm, (1.0,) * arm.n)[0]


def _column(arm: Arm, moving: Moving, j: int, look: Look) -> Marks:
    """Return the velocity that joint j causes with speed 1, its axis, and the lever from the axis to the tool."""
    colour, p, origin = joint_colour(j), moving.point, moving.origins[j]
    linear, angular = moving.J[:3, j], moving.J[3:, j]
    arrows: list[Segment] = [(p, p + unit_scale(arm) * linear, colour)]
    direction = angular if arm.revolute[j] else linear
    reached = REACHED * look.size * direction
    strokes: list[Segment] = [(origin - reached, origin + reached, colour)]
    if arm.revolute[j]:
        arrows.append((origin, origin + UNIT * look.size * angular, colour))
        foot = origin + float((p - origin) @ angular) * angular
        strokes.append((foot, p, GREY))
    label = f"{subscript('j', j + 1)}: {speed_per_unit(float(np.linalg.norm(linear)), j, 0, arm, look.units)}"
    return Marks(_long(arrows, look), strokes, label, p + unit_scale(arm) * linear)


def _row(arm: Arm, moving: Moving, i: int, look: Look) -> Marks:
    """Return at each joint its share of component i with speed 1, along the axis of the component."""
    axis = moving.axes[:, i % 3]
    scale = unit_scale(arm) if i < 3 else UNIT * look.size
    arrows: list[Segment] = []
    for j, value in enumerate(moving.matrix[i]):
        start = moving.origins[j]
        arrows.append((start, start + scale * float(value) * axis, joint_colour(j)))
    p = moving.point
    strokes: list[Segment] = [(p, p + UNIT * look.size * axis, COLOURS[i % 3])]
    name = f"{'v' if i < 3 else 'ω'} along {'xyz'[i % 3]}"
    return Marks(_long(arrows, look), strokes, f"{name} of each joint", p + UNIT * look.size * axis)


def _entry(arm: Arm, moving: Moving, i: int, j: int, look: Look) -> Marks:
    """Return the component of a column along one axis, beside the column."""
    value, axis = float(moving.matrix[i, j]), moving.axes[:, i % 3]
    if i < 3:
        start, scale, whole = moving.point, unit_scale(arm), moving.J[:3, j]
    else:
        start, scale, whole = moving.origins[j], UNIT * look.size, moving.J[3:, j]
    end, foot = start + scale * whole, start + scale * value * axis
    arrows = _long([(start, end, joint_colour(j)), (start, foot, COLOURS[i % 3])], look)
    strokes: list[Segment] = [(foot, end, GREY)] if float(np.linalg.norm(end - foot)) > LEAST * look.size else []
    return Marks(arrows, strokes, speed_per_unit(value, j, i, arm, look.units), foot)


def speed_per_unit(value: float, j: int, i: int, arm: Arm, units: Units) -> str:
    """Return an entry of J (row i, joint j, both 0-based) with its unit."""
    if i >= 3:
        return f"{number(value, 3)} rad/rad" if arm.revolute[j] else "0"
    if arm.revolute[j]:
        return f"{units.text(value, False)} {units.length_unit}/rad"
    return f"{number(value, 3)} m/m"


def _long(arrows: list[Segment], look: Look) -> list[Segment]:
    """Return the arrows that are long enough to be drawn."""
    return [arrow for arrow in arrows if float(np.linalg.norm(arrow[1] - arrow[0])) > LEAST * look.size]
