"""The outline of a zonotope, the image of a box under a linear map, for drawing."""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FLAT = 1e-4
"""Thickness relative to the length below which it is drawn flat, or as a line, and sine of the angle below which a
direction lies in a plane."""


class Outline(NamedTuple):
    """The outline of a zonotope.

    Attributes
    ----------
    rank : int
        1 for a line, 2 for a polygon, 3 for a body; 0 if there is only a point.
    polygons : list of ndarray, shape (k, 3)
        Its flat sides, one of them for a polygon, and none for a line or a point; corners in order.
    """

    rank: int
    polygons: list[Floats]

    @property
    def triangles(self) -> Floats:
        """The sides cut into triangles, shape (m, 3, 3)."""
        cut = [(side[0], side[i], side[i + 1]) for side in self.polygons for i in range(1, len(side) - 1)]
        return np.array(cut, dtype=np.float64).reshape(-1, 3, 3)


def outline(generators: Floats) -> Outline:
    """Return the outline of ``G b`` over the box ``|b_i| <= 1``.

    A side of it is spanned by the generators that lie in one plane; the others are on the end of their interval that
    is farther out along the normal of that plane.

    Parameters
    ----------
    generators : ndarray, shape (3, n)
        One column for each direction.

    Examples
    --------
    >>> found = outline(np.eye(3))
    >>> found.rank, len(found.polygons), found.triangles.shape
    (3, 6, (12, 3, 3))
    """
    axes, sizes, _ = np.linalg.svd(generators)
    rank = int((sizes > FLAT * sizes[0]).sum()) if sizes[0] > 0.0 else 0
    columns = [g for g in generators.T if np.linalg.norm(g) > FLAT * sizes[0]]
    if rank < 2:
        return Outline(rank, [])
    if rank == 2:
        return Outline(2, [_polygon(columns, axes[:, 2])])
    sides: dict[tuple[bool, ...], list[Floats]] = {}
    for one, other in combinations(columns, 2):
        normal = np.cross(one, other)
        length = float(np.linalg.norm(normal))
        if length <= FLAT * float(np.linalg.norm(one) * np.linalg.norm(other)):
            continue
        normal = normal / length
        along = np.array([normal @ g for g in columns])
        inside = np.abs(along) <= FLAT * np.linalg.norm(columns, axis=1)
        key = tuple(inside.tolist())  # several pairs span the same side
        if key not in sides:
            flat = _polygon([g for g, within in zip(columns, inside, strict=True) if within], normal)
            out = np.sign(along) * ~inside @ np.array(columns)
            sides[key] = [flat + out, flat - out]
    return Outline(3, [side for pair in sides.values() for side in pair])


def _polygon(generators: list[Floats], normal: Floats) -> Floats:
    """Return the corners of the zonotope of generators across a normal, in order, shape (2 k, 3)."""
    x = generators[0] / np.linalg.norm(generators[0])
    y = np.cross(normal, x)
    upwards = [g if (g @ y, g @ x) > (0.0, 0.0) else -g for g in generators]
    upwards.sort(key=lambda g: float(np.arctan2(max(float(g @ y), 0.0), float(g @ x))))
    corner = -np.sum(upwards, axis=0)
    corners = []
    for step in (*upwards, *(-g for g in upwards)):
        corners.append(corner)
        corner = corner + 2.0 * step
    return np.array(corners)
