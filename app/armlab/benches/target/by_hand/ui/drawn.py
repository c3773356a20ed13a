"""The shapes of a step as lines, faces and names in the world."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.by_hand.ui.formula import plain, with_unit
from armlab.kin.ik.by_hand import Arc, Circle, Point, Segment, Shape, Step, Triangle
from armlab.ui.scene._marks import across
from armlab.ui.scene._strokes import Segments, dashes, polyline
from armlab.ui.units import Units

Floats = NDArray[np.float64]

ROLES = ("given", "wanted", "found", "helper")

BESIDE = {"given": 0.4, "wanted": 0.62, "found": 0.5, "helper": 0.5}
"""Place of the name of a length, in parts of it, by role: names of neighbouring sides do not meet."""

ARC_PARTS, CIRCLE_PARTS, DASHES = 32, 96, 14
"""Numbers of strokes of an angle and of a circle, and of dashes of a helping line."""


@dataclass(frozen=True, eq=False)
class Picture:
    """The lines, points, faces and names of a step.

    Attributes
    ----------
    lines : dict of str to ndarray, shape (k, 2, 3)
        By role.
    points : dict of str to ndarray, shape (k, 3)
    faces : list of ndarray, shape (3, 3)
    names : list of (str, ndarray)
        Texts and where they stand.
    """

    lines: dict[str, Segments] = field(default_factory=dict)
    points: dict[str, Floats] = field(default_factory=dict)
    faces: list[Floats] = field(default_factory=list)
    names: list[tuple[str, Floats]] = field(default_factory=list)


def picture_of(step: Step, base: Floats, units: Units) -> Picture:
    """Return what is drawn of a step, in the world; ``base`` is frame 0 there."""
    picture = Picture()
    lines: dict[str, list[Segments]] = {role: [] for role in ROLES}
    points: dict[str, list[Floats]] = {role: [] for role in ROLES}

    def world(at: Floats) -> Floats:
        return np.asarray(at @ base[:3, :3].T + base[:3, 3], dtype=np.float64)

    for shape in step.shapes:
        if isinstance(shape, Segment):
            start, end = world(shape.start), world(shape.end)
            lines[shape.role].append(_straight(start, end, shape.role))
            _named(picture, step, shape.of, start + BESIDE[shape.role] * (end - start), units)
        elif isinstance(shape, Arc):
            way = world(arc_points(shape))
            lines[shape.role].append(polyline(way))
            # Outside the arc, where nothing else is written.
            _named(
                picture, step, shape.of, world(shape.centre) + 1.2 * (way[len(way) // 2] - world(shape.centre)), units
            )
        elif isinstance(shape, Circle):
            lines[shape.role].append(polyline(world(circle_points(shape))))
        elif isinstance(shape, Triangle):
            picture.faces.append(world(shape.corners))
        else:
            at = world(shape.at)
            points[shape.role].append(at)
            if shape.name:
                picture.names.append((shape.name, at))
    picture.lines.update({role: np.concatenate(some) for role, some in lines.items() if some})
    picture.points.update({role: np.array(some) for role, some in points.items() if some})
    return picture


def _straight(start: Floats, end: Floats, role: str) -> Segments:
    return dashes(start, end, DASHES) if role == "helper" else polyline(np.array([start, end]))


def _named(picture: Picture, step: Step, of: str, at: Floats, units: Units) -> None:
    quantity = step.values.get(of)
    if quantity is not None and isinstance(quantity.value, float):
        picture.names.append((f"{plain(quantity.symbol)} {with_unit(quantity, units)}", at))


def arc_points(arc: Arc) -> Floats:
    """Return points (k, 3) along the arc of an angle."""
    angles = np.linspace(0.0, arc.angle, ARC_PARTS + 1)
    axis = np.asarray(arc.normal)
    along = (axis @ arc.start) * axis
    flat = arc.start - along
    side = np.cross(axis, arc.start)
    return np.asarray(arc.centre + along + np.cos(angles)[:, None] * flat + np.sin(angles)[:, None] * side)


def circle_points(circle: Circle) -> Floats:
    """Return points (k, 3) around a circle; the last is the first."""
    angles = np.linspace(0.0, 2.0 * np.pi, CIRCLE_PARTS + 1)[:, None]
    start = circle.radius * across(circle.normal)
    side = np.cross(circle.normal, start)
    return np.asarray(circle.centre + np.cos(angles) * start + np.sin(angles) * side)


def corners_of_shapes(shapes: Iterable[Shape]) -> Floats:
    """Return the ends and corners of shapes (k, 3) in frame 0; of circles nothing, which may be large."""
    found: list[Floats] = []
    for shape in shapes:
        if isinstance(shape, Segment):
            found += [shape.start, shape.end]
        elif isinstance(shape, Triangle):
            found += list(shape.corners)
        elif isinstance(shape, Point):
            found.append(shape.at)
    return np.array(found).reshape(-1, 3)
