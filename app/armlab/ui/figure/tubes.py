"""Round tubes along a path with filleted corners and domed ends."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import SIDES, circle, skin

FILLET_POINTS = 9
DOME_RINGS = 4

Array = NDArray[np.float64]


def tube(points: Sequence[ArrayLike], start: float, end: float, bend: float) -> Solid:
    """Return a round tube through points with filleted corners and domed ends.

    Parameters
    ----------
    points : sequence of array_like, shape (3,)
    start, end : float
        Radii at the ends; linear along the path in between.
    bend : float
        Radius of the fillets, as far as the legs allow.
    """
    path = _filleted([np.asarray(p, dtype=float) for p in points], bend)
    steps = np.diff(path, axis=0)
    directions = np.concatenate([steps[:1], path[2:] - path[:-2], steps[-1:]])
    directions /= np.sqrt((directions**2).sum(axis=1))[:, None]
    lengths = np.concatenate([[0.0], np.cumsum(np.sqrt((steps**2).sum(axis=1)))])
    radii = start + (end - start) * lengths / lengths[-1]
    return _around(path, directions, radii, (start - end) / float(lengths[-1]))


def _filleted(corners: list[Array], bend: float) -> Array:
    t = np.linspace(0.0, 1.0, FILLET_POINTS)[:, None]
    path = [corners[0][None]]
    for before, corner, after in zip(corners, corners[1:], corners[2:], strict=False):
        into, out = corner - before, after - corner
        into_length, out_length = math.sqrt(into @ into), math.sqrt(out @ out)
        into, out = into / into_length, out / out_length
        angle = math.acos(min(max(float(into @ out), -1.0), 1.0))
        cut = min(bend * math.tan(angle / 2.0), 0.48 * into_length, 0.48 * out_length)
        a, b = corner - cut * into, corner + cut * out
        path.append((1 - t) ** 2 * a + 2 * t * (1 - t) * corner + t * t * b)
    return np.concatenate([*path, corners[-1][None]])


def _around(path: Array, directions: Array, radii: Array, taper: float) -> Solid:
    """Return the surface around a path: circles along it, and a dome at either end."""
    across = _carried(directions)
    other = np.cross(directions, across)
    at, wide, ahead = _rings(len(path))
    cosines, sines = circle(SIDES)
    round_it = cosines[:, None] * across[at, None] + sines[:, None] * other[at, None]
    centres = path[at] + (ahead * radii[at])[:, None] * directions[at]
    rings = centres[:, None] + (wide * radii[at])[:, None, None] * round_it
    normals = wide[:, None, None] * round_it + (ahead + taper * wide)[:, None, None] * directions[at, None]
    normals /= np.sqrt(1.0 + 2.0 * taper * wide * ahead + (taper * wide) ** 2)[:, None, None]
    ends = path[[0, -1]] + np.array([-radii[:1], radii[-1:]]) * directions[[0, -1]]
    return Solid(
        np.concatenate([ends[:1], rings.reshape(-1, 3), ends[1:]]),
        np.concatenate([-directions[:1], normals.reshape(-1, 3), directions[-1:]]),
        skin((False,) * len(at), SIDES),
    )


def _carried(directions: Array) -> Array:
    """Return a normal at each point, without twist along the path, so that neighbouring quads match."""
    first = directions[0]
    normal = np.cross(first, [1.0, 0.0, 0.0] if abs(first[0]) < 0.8 else [0.0, 1.0, 0.0]).tolist()
    found = []
    for x, y, z in directions.tolist():
        nx, ny, nz = normal
        along = nx * x + ny * y + nz * z
        nx, ny, nz = nx - along * x, ny - along * y, nz - along * z
        length = math.sqrt(nx * nx + ny * ny + nz * nz)
        normal = nx / length, ny / length, nz / length
        found.append(normal)
    return np.array(found)


@cache
def _rings(count: int) -> tuple[NDArray[np.int64], Array, Array]:
    """Return for each ring of ``count`` points its point, its width and its advance, in radii."""
    bulge = np.linspace(0.0, np.pi / 2.0, DOME_RINGS)[:-1]
    level = np.zeros(count - 2)
    at = np.concatenate([np.zeros(len(bulge)), np.arange(1, count - 1), np.full(len(bulge), count - 1)])
    wide = np.concatenate([np.cos(bulge[::-1]), level + 1.0, np.cos(bulge)])
    ahead = np.concatenate([-np.sin(bulge[::-1]), level, np.sin(bulge)])
    return at.astype(np.int64), wide, ahead
