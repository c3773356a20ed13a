"""Solids of wheels with teeth: outlines that are extruded, with a rim, a web and a hub."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.ui.figure.mesh import Solid, joined

Floats = NDArray[np.float64]


def ring(outside: Floats, inside: Floats, thick: float) -> Solid:
    """Return the ring between two closed lines of as many points, extruded along z around the origin.

    Parameters
    ----------
    outside, inside : ndarray, shape (k, 2)
        Counterclockwise; point i of one is beside point i of the other.
    thick : float
    """
    k, half = len(outside), 0.5 * thick
    here = np.arange(k)
    on = np.roll(here, -1)
    flat = np.concatenate([outside, inside])
    up = np.concatenate([np.column_stack([here, on, k + on]), np.column_stack([here, k + on, k + here])])
    ends = [
        Solid(
            np.column_stack([flat, np.full(2 * k, side * half)]),
            np.tile([0.0, 0.0, side], (2 * k, 1)),
            up if side > 0.0 else up[:, ::-1],
        )
        for side in (1.0, -1.0)
    ]
    return joined([*ends, _wall(outside, half), _wall(inside[::-1], half)])


def _wall(line: Floats, half: float) -> Solid:
    """Return the wall over a closed line, whose outside is to the right of the way along it, with flat pieces."""
    k, after = len(line), np.roll(line, -1, axis=0)
    way = after - line
    length = np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-12)
    normal = np.column_stack([way[:, 1], -way[:, 0]]) / length
    corners = [(line, -half), (after, -half), (after, half), (line, half)]
    vertices = np.concatenate([np.column_stack([points, np.full(k, z)]) for points, z in corners])
    normals = np.tile(np.column_stack([normal, np.zeros(k)]), (4, 1))
    here = np.arange(k)
    faces = np.concatenate(
        [np.column_stack([here, k + here, 2 * k + here]), np.column_stack([here, 2 * k + here, 3 * k + here])]
    )
    return Solid(vertices, normals, faces)


def circle_beside(line: Floats, radius: float) -> Floats:
    """Return points of a circle at the same angles as those of a line, shape (k, 2)."""
    angles = np.arctan2(line[:, 1], line[:, 0])
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])
