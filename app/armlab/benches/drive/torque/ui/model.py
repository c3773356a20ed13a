"""The solids of the model: magnets, coils of wire, commutator or slip rings, brushes; lengths in units of the model.

x goes from the north to the south pole, y along the axis of the rotor away from the brushes, z up.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import ORANGE, PURPLE, Rgb
from armlab.ui.figure.glb import Look, scene_glb
from armlab.ui.figure.mesh import Solid, joined, placed
from armlab.ui.figure.solids import along, block, drum
from armlab.ui.figure.tubes import tube

Floats = NDArray[np.float64]

ARM, SIDE = 0.75, 1.0
"""Distance of the sides of a coil from the axis, and half their length."""

WIRE, BEND = 0.045, 0.09
"""Radius of a coil's wires, all turns together, and of its bends."""

MAGNET, GAP = (0.55, 2.1, 1.5), 1.05
"""Size of a magnet, and the distance of its pole from the axis."""

RING, WALL, RING_AT, WIDE = 0.24, 0.06, -1.62, 0.15
"""Radius, wall, place on the axis and half width of the commutator."""

SLIP = 0.2
"""Angle between two segments of the commutator, in parts of a segment."""

HALF = (1.75, 1.9, 1.25)
"""Half edges of the box that holds the model."""

NORTH: Rgb = (196, 60, 40)
SOUTH: Rgb = (0, 114, 178)
COPPER: Look = ((196, 124, 74), 0.35, 0.3)
STEEL: Look = ((178, 186, 196), 0.3, 0.4)
COAL: Look = ((58, 62, 70), 0.7, 0.0)
PALE: Look = ((176, 150, 128), 0.5, 0.1)
"""Looks of what is seen."""

STEP = math.radians(6.0)
"""Angle between points of an arc, radians."""


@cache
def magnet(side: float) -> Solid:
    """Return a magnet, at the left (-1) or at the right (1)."""
    return block(MAGNET, 0.06, (side * (GAP + 0.5 * MAGNET[0]), 0.0, 0.0))


@cache
def brushes_glb(switched: bool) -> bytes:
    """Return the brushes: at one place of the axis on a commutator, one behind the other on slip rings."""
    away = RING + 0.11
    places = [(away, 0.0), (-away, 0.0)] if switched else [(away, -0.75 * WIDE), (-away, 0.75 * WIDE)]
    deep = 1.6 * WIDE if switched else 0.7 * WIDE
    return scene_glb([(joined([block((0.2, deep, 0.14), 0.02, (x, RING_AT + y, 0.0)) for x, y in places]), COAL)])


@cache
def shaft_glb(coils: int, switched: bool) -> bytes:
    """Return shaft and commutator with two segments a coil, or two slip rings; they turn with the rotor."""
    shaft = placed(drum(0.07, 1.5, 0.02), along((0.0, 1.0, 0.0), (0.0, -0.35, 0.0)))
    if switched:
        angle = math.pi / coils
        half = 0.5 * angle * (1.0 - SLIP * min(1.0, 0.25 * coils))
        # The segment of the first side is where its lever arm is.
        rings = [_sector(k * angle - half, k * angle + half, RING_AT, WIDE) for k in range(2 * coils)]
    else:
        rings = [_sector(0.0, 2.0 * math.pi, RING_AT + sign * 0.75 * WIDE, 0.4 * WIDE) for sign in (-1.0, 1.0)]
    core = placed(drum(RING - WALL, WIDE + 0.06, 0.02), along((0.0, 1.0, 0.0), (0.0, RING_AT, 0.0)))
    return scene_glb([(shaft, STEEL), (core, COAL), (joined(rings), COPPER)])


@cache
def coil_glb(first: bool) -> bytes:
    """Return a coil whose first side is up; the first coil has a colour for each side."""
    near, inner = -SIDE, RING - 0.5 * WALL
    ring = RING_AT + 0.5 * WIDE

    def half(sign: float) -> Solid:
        path = [
            (0.0, ring, sign * inner),
            (0.0, near - 0.1, sign * inner),
            (0.0, near, sign * ARM),
            (0.0, SIDE, sign * ARM),
            (0.0, SIDE, 0.0),
        ]
        wire = WIRE if first else 0.6 * WIRE
        return tube(path, wire, wire, BEND)

    if not first:
        return scene_glb([(joined([half(1.0), half(-1.0)]), PALE)])
    return scene_glb([(half(1.0), (ORANGE, 0.45, 0.0)), (half(-1.0), (PURPLE, 0.45, 0.0))])


def _sector(start: float, end: float, at: float, half: float) -> Solid:
    """Return a part of a ring about y between two angles, counted from z towards x."""
    count = 2 + int((end - start) / STEP)
    angles = np.linspace(start, end, count)
    rays = np.stack([np.sin(angles), np.zeros(count), np.cos(angles)], axis=1)
    corners = [(RING, at - half), (RING, at + half), (RING - WALL, at + half), (RING - WALL, at - half)]
    lines = [radius * rays + np.array([0.0, y, 0.0]) for radius, y in corners]
    faces = [
        _strip(lines[0], lines[1], rays),
        _strip(lines[1], lines[2], np.tile([0.0, 1.0, 0.0], (count, 1))),
        _strip(lines[2], lines[3], -rays),
        _strip(lines[3], lines[0], np.tile([0.0, -1.0, 0.0], (count, 1))),
    ]
    for k, sign in ((0, -1.0), (-1, 1.0)):
        normal = sign * np.cross(np.array([0.0, 1.0, 0.0]), rays[k])
        square = np.array([line[k] for line in lines])
        order = [[0, 1, 2], [0, 2, 3]] if sign < 0.0 else [[0, 2, 1], [0, 3, 2]]
        faces.append(Solid(square, np.tile(normal, (4, 1)), np.array(order)))
    return joined(faces)


def _strip(one: Floats, other: Floats, normals: Floats) -> Solid:
    """Return the band between two lines of points, with its outside where the normals point."""
    count = len(one)
    k = np.arange(count - 1)
    faces = np.concatenate([np.column_stack([k, k + count, k + 1]), np.column_stack([k + 1, k + count, k + count + 1])])
    points = np.concatenate([one, other])
    a, b, c = points[faces[0]]
    if np.cross(b - a, c - a) @ normals[0] < 0.0:
        faces = faces[:, [0, 2, 1]]
    return Solid(points, np.concatenate([normals, normals]), faces)
