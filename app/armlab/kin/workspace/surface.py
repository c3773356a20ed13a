"""The boundary of a workspace as a surface, and points near it: the section moved by joint 1."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.workspace.section import Section

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

STEPS = 72
"""Number of pieces of a whole turn of joint 1, or of its whole stroke."""

FINEST = 160
"""Largest number of pieces of the outline of a section that are drawn."""


class Surface(NamedTuple):
    """Triangles.

    Attributes
    ----------
    vertices : ndarray, shape (k, 3)
        In the world, metres.
    faces : ndarray, shape (m, 3)
        Indices of vertices.
    """

    vertices: Floats
    faces: NDArray[np.int64]


def surface(section: Section) -> Surface:
    """Return the boundary of a spatial workspace; of a planar one, which has none, no triangles.

    The outline carried by joint 1 through all it covers and, where joint 1 is limited, the walls at which that ends, in
    squares of the coarse cells in which the ends are known.
    """
    quads = np.zeros((0, 4, 3))
    if not section.joint.planar:
        quads = np.concatenate([_carried(section), _walls(section), _faces(section)])
    faces = np.arange(4 * len(quads)).reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return Surface(section.joint.join(quads).reshape(-1, 3), faces)


def near_boundary(section: Section, points: ArrayLike, width: float) -> Bools:
    """Return which points are nearer to the boundary than a width in metres, to about a cell of the section.

    Parameters
    ----------
    section : Section
    points : array_like, shape (k, 3)
        In the world, metres.
    width : float
    """
    from scipy.spatial import cKDTree  # type: ignore[import-untyped]

    split = section.joint.split(points)
    begins, ends = section.boundary.edges
    if not len(begins):
        return np.ones(len(split), dtype=bool)
    pieces = [begins + (ends - begins) * part for part in (0.0, 1 / 3, 2 / 3)]
    near = np.asarray(cKDTree(np.concatenate(pieces)).query(split[:, :2])[0] <= width)
    return near | _near_walls(section, split, width)


def _carried(section: Section) -> Floats:
    """Return squares (k, 4, 3) in (u, v, s) of the outline carried by joint 1."""
    found = []
    for line in section.contours:
        line = line[:: -(-len(line) // FINEST)]
        line = np.concatenate([line, line[:1]]) if not np.array_equal(line[0], line[-1]) else line
        for a, b in pairwise(line):
            for start, length in _intervals(section, 0.5 * (a + b)):
                found.append(_strip(a, b, start, length, section.joint.revolute))
    return np.concatenate(found) if found else np.zeros((0, 4, 3))


def _strip(a: Floats, b: Floats, start: float, length: float, turns: bool) -> Floats:
    steps = max(1, math.ceil(STEPS * length / math.tau)) if turns else 1
    s = start + length * np.arange(steps + 1) / steps
    corners = [(*a, s[:-1]), (*b, s[:-1]), (*b, s[1:]), (*a, s[1:])]
    return np.stack([np.stack(np.broadcast_arrays(u, v, at), axis=-1) for u, v, at in corners], axis=1)


def _intervals(section: Section, place: Floats) -> list[tuple[float, float]]:
    """Return start and length of the covered intervals of s near a place (u, v) of the outline."""
    if section.arcs is None:
        return [(0.0, math.tau)]
    rows, columns = section.filled.shape
    i = int(np.clip(np.rint((place[0] - section.u[0]) / section.step), 0, rows - 1))
    j = int(np.clip(np.rint((place[1] - section.v[0]) / section.step), 0, columns - 1))
    wide = section.grid.coarser
    cell = i // wide * -(-columns // wide) + j // wide
    pairs = zip(section.arcs.start[cell].tolist(), section.arcs.length[cell].tolist(), strict=True)
    return [(start, length) for start, length in pairs if length > 0.0]


def _walls(section: Section) -> Floats:
    """Return squares (k, 4, 3) in (u, v, s) at the ends of the range of joint 1."""
    arcs = section.arcs
    if arcs is None:
        return np.zeros((0, 4, 3))
    wide = section.grid.coarser
    columns = -(-section.filled.shape[1] // wide)
    side, u0, v0 = wide * section.step, section.u[0] - 0.5 * section.step, section.v[0] - 0.5 * section.step
    cells, which = np.nonzero((arcs.length > 0.0) & (arcs.length < arcs.period * (1.0 - 1e-9)))
    u, v = u0 + side * (cells // columns), v0 + side * (cells % columns)
    found = []
    for s in (arcs.start[cells, which], arcs.start[cells, which] + arcs.length[cells, which]):
        corners = [(u, v), (u + side, v), (u + side, v + side), (u, v + side)]
        found.append(np.stack([np.stack([a, b, s], axis=-1) for a, b in corners], axis=1))
    return np.concatenate(found)


def _faces(section: Section) -> Floats:
    """Return squares (k, 4, 3) in (u, v, s) where only one of two neighbouring cells covers s."""
    if section.arcs is None:
        return np.zeros((0, 4, 3))
    edges, s = section.boundary.faces
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return np.stack([np.column_stack([edges[:, end], s[:, side]]) for end, side in corners], axis=1)


def _near_walls(section: Section, split: Floats, width: float) -> Bools:
    """Return which points (k, 3) in (u, v, s) are near an end of the range of joint 1 there."""
    arcs = section.arcs
    if arcs is None:
        return np.zeros(len(split), dtype=bool)
    (rows, columns), wide = section.filled.shape, section.grid.coarser
    i = np.clip(np.rint((split[:, 0] - section.u[0]) / section.step), 0, rows - 1).astype(int) // wide
    j = np.clip(np.rint((split[:, 1] - section.v[0]) / section.step), 0, columns - 1).astype(int) // wide
    cell = i * -(-columns // wide) + j
    start, length = arcs.start[cell], arcs.length[cell]
    limited = (length > 0.0) & (length < arcs.period * (1.0 - 1e-9))
    away = np.full(len(split), np.inf)
    for ends in (start, start + length):
        gap = np.abs(split[:, 2:] - ends)
        if section.joint.revolute:
            gap = np.minimum(np.mod(gap, math.tau), math.tau - np.mod(gap, math.tau))
        away = np.minimum(away, np.where(limited, gap, np.inf).min(axis=1))
    ends = np.isfinite(away)
    return np.asarray(ends & (np.where(ends, away, 0.0) * section.joint.measure(split[:, 0]) <= width))
