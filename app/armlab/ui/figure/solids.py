"""Solids of which the arms are made, with bevelled edges that catch the light."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.ui.figure.mesh import Solid, cut

SIDES = 20
"""Number of sides of round solids: a software renderer needs time for each vertex."""

WIDE_SIDES = 32
"""Number of sides of a base plate, whose edge is seen against the ground."""

CREASE = math.radians(35.0)
"""Angle of an edge, radians, above which it stays sharp."""

NEAR_X = 0.9
"""Component of a direction along x above which its pose takes the x axis from y instead."""

_Corner = tuple[NDArray[np.float64], NDArray[np.bool_]]
"""A vertex of a bevelled box: the signs of its corner, and the axes along which the bevel moves it."""


def lathe(profile: Sequence[tuple[float, float]], sides: int = SIDES, soft: bool = False) -> Solid:
    """Return a solid of revolution about z.

    Parameters
    ----------
    profile : sequence of (float, float)
        Radii and heights, bottom to top; the first and the last point are on the axis.
    sides : int
    soft : bool
        Shade level ends as if they bulged into their bevel; else they are as flat as they look.
    """
    segments = [_outwards(a, b) for a, b in pairwise(profile)]
    rings: list[tuple[float, float, float, float]] = []
    creases = []
    for (r, z), (below, above) in zip(profile[1:-1], pairwise(segments), strict=True):
        turn = below[0] * above[0] + below[1] * above[1]
        level = 1.0 in (abs(below[1]), abs(above[1]))
        creases.append(turn < math.cos(CREASE) or (level and not soft))
        if creases[-1]:
            rings += [(r, z, *below), (r, z, *above)]
        else:
            length = math.sqrt(2.0 + 2.0 * turn)
            rings.append((r, z, (below[0] + above[0]) / length, (below[1] + above[1]) / length))
    r, z, across, up = np.array(rings).T[:, :, None]
    (cosines, sines), ones = circle(sides), np.ones(sides)
    around = np.array([r * cosines, r * sines, z * ones]).reshape(3, -1).T
    normals = np.array([across * cosines, across * sines, up * ones]).reshape(3, -1).T
    return Solid(
        np.concatenate([[(0.0, 0.0, profile[0][1])], around, [(0.0, 0.0, profile[-1][1])]]),
        np.concatenate([[(0.0, 0.0, -1.0)], normals, [(0.0, 0.0, 1.0)]]),
        skin(tuple(creases), sides),
    )


def _outwards(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the normal of a segment of a profile: across and up."""
    across, up = b[1] - a[1], a[0] - b[0]
    length = math.hypot(across, up)
    return across / length, up / length


@cache
def circle(sides: int) -> NDArray[np.float64]:
    """Return cosines and sines, shape (2, sides)."""
    phi = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    return np.array([np.cos(phi), np.sin(phi)])


@cache
def skin(creases: tuple[bool, ...], sides: int) -> NDArray[np.int64]:
    """Return the faces over rings of vertices between two ends; where there is a crease, a ring comes twice.

    The first vertex is the lower end, then follow the rings, then the upper end.
    """
    i = np.arange(sides)
    j = (i + 1) % sides
    faces, ring = [np.column_stack([0 * i, 1 + j, 1 + i])], 1 + sides * int(creases[0])
    for crease in creases[1:]:
        a, b = ring, ring + sides
        faces += [np.column_stack([a + i, a + j, b + j]), np.column_stack([a + i, b + j, b + i])]
        ring = b + sides * int(crease)
    faces.append(np.column_stack([ring + i, ring + j, 0 * i + ring + sides]))
    return np.vstack(faces)


def drum(
    radius: float, half_length: float, bevel: float, z: float = 0.0, soft: bool = False, sides: int = SIDES
) -> Solid:
    """Return a cylinder about z with rounded edges and its middle at height z; for ``soft`` see `lathe`."""
    r, h, b = radius, half_length, bevel
    rim = [(r - b, -h), (r - 0.3 * b, -h + 0.3 * b), (r, -h + b), (r, h - b), (r - 0.3 * b, h - 0.3 * b), (r - b, h)]
    return lathe([(0.0, z - h), *((x, z + y) for x, y in rim), (0.0, z + h)], sides, soft)


def band(radius: float, half_length: float, bevel: float, z: float = 0.0) -> Solid:
    """Return the outside of a cylinder about z with cut edges: a ring around something that hides its ends."""
    r, h, b = radius, half_length, bevel
    rim = [(r - b, z - h), (r, z - h + b), (r, z + h - b), (r - b, z + h)]
    return cut(_turned(rim, SIDES), SIDES, SIDES)


def lid(radius: float, height: float, bevel: float, z: float, up: bool = True, sides: int = SIDES) -> Solid:
    """Return a flat cylinder on top of something at height z, or below it, without the hidden end."""
    r, h, b = radius, height, bevel
    if up:
        return cut(_turned([(r, z), (r, z + h - b), (r - b, z + h)], sides), sides, 0)
    return cut(_turned([(r - b, z - h), (r, z - h + b), (r, z)], sides), 0, sides)


def _turned(rim: list[tuple[float, float]], sides: int) -> Solid:
    """Return the solid of revolution of a rim, with flat ends closed."""
    return lathe([(0.0, rim[0][1]), *rim, (0.0, rim[-1][1])], sides)


def block(size: ArrayLike, bevel: float, at: ArrayLike = (0.0, 0.0, 0.0)) -> Solid:
    """Return a box with bevelled edges around a point."""
    full, less, normals, faces = _facets()
    vertices = full * (np.asarray(size, dtype=float) / 2.0) - bevel * less + np.asarray(at, dtype=float)
    return Solid(vertices, normals, faces)


@cache
def _facets() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Return what all bevelled boxes share: signs of corners, the part of them that the bevel moves, normals, faces.

    Each corner of the box is three vertices, one on each side that meets there. A box has 6 sides, 12 edges and 8
    corners; all of its facets are flat, for even a corner and an edge meet at 35.26 degrees.
    """
    signs = [np.array(index) * 2.0 - 1.0 for index in np.ndindex(2, 2, 2)]
    full: list[NDArray[np.float64]] = []
    less: list[NDArray[np.float64]] = []
    normals: list[NDArray[np.float64]] = []
    faces: list[tuple[int, int, int]] = []
    for towards in np.ndindex(3, 3, 3):
        n = np.array(towards) - 1.0
        sides = np.flatnonzero(n)
        own = [(sign, np.arange(3) != side) for sign in signs if np.all(sign[sides] == n[sides]) for side in sides]
        if own:
            start = len(full)
            own = _counterclockwise(own, n)
            faces += [(start, start + k, start + k + 1) for k in range(1, len(own) - 1)]
            full += [sign for sign, _ in own]
            less += [sign * moved for sign, moved in own]
            normals += [n / np.linalg.norm(n)] * len(own)
    return np.array(full), np.array(less), np.array(normals), np.array(faces)


def _counterclockwise(own: list[_Corner], normal: NDArray[np.float64]) -> list[_Corner]:
    """Return the corners of a facet in order around its normal."""
    points = [sign * (2.0 - 0.5 * moved) for sign, moved in own]
    middle = np.mean(points, axis=0)
    x = points[0] - middle
    y = np.cross(normal / np.linalg.norm(normal), x)
    angles = [math.atan2(float((point - middle) @ y), float((point - middle) @ x)) for point in points]
    return [own[k] for k in np.argsort(angles)]


def along(direction: ArrayLike, at: ArrayLike = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """Return a 4 x 4 pose at a point with its z axis along a direction."""
    (x, y, z), (px, py, pz) = np.asarray(direction, dtype=float).tolist(), np.asarray(at, dtype=float).tolist()
    length = math.hypot(x, y, z)
    x, y, z = x / length, y / length, z / length
    # The x axis of the pose: that of the world, or its y axis where that is too near, made square to z.
    a, b, c = (1.0 - x * x, -x * y, -x * z) if abs(x) < NEAR_X else (-x * y, 1.0 - y * y, -y * z)
    length = math.hypot(a, b, c)
    a, b, c = a / length, b / length, c / length
    return np.array(
        [
            [a, y * c - z * b, x, px],
            [b, z * a - x * c, y, py],
            [c, x * b - y * a, z, pz],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def torus(radius: float, tube: float, sides: int = 72) -> Solid:
    """Return a ring in the plane across z, around the origin."""
    around = 12
    (c, s), (cosines, sines) = circle(sides)[:, :, None], circle(around)[:, None, :]
    normals = np.stack([c * cosines, s * cosines, sines + 0.0 * c], axis=-1)
    middles = np.stack([c + 0.0 * sines, s + 0.0 * sines, 0.0 * c * sines], axis=-1)
    here = np.arange(sides * around).reshape(sides, around)
    on, up = np.roll(here, -1, axis=0), np.roll(here, -1, axis=1)
    both = np.roll(on, -1, axis=1)
    faces = np.concatenate([np.stack([here, on, both], axis=-1), np.stack([here, both, up], axis=-1)]).reshape(-1, 3)
    return Solid((radius * middles + tube * normals).reshape(-1, 3), normals.reshape(-1, 3), faces)
