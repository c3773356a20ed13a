"""Faces of a workspace between neighbouring coarse cells, where joint 1 covers s in only one of them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.work import Work
from armlab.kin.workspace.around import Arcs
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

COMPARED = 144
"""Number of values of s at which neighbouring cells are compared."""

TOGETHER = 1024
"""Cells, or pairs of them, that are examined in one piece of work."""


class Faces(NamedTuple):
    """Squares that close a workspace inside.

    Attributes
    ----------
    edges : ndarray, shape (k, 2, 2)
        Both ends, in (u, v), of the side that two cells share.
    s : ndarray, shape (k, 2)
        Start and end of the range of s, rad or m.
    """

    edges: Floats
    s: Floats


def finding_faces(grid: Grid, arcs: Arcs) -> Work[Faces]:
    """Return, in pieces of work, the faces where s is covered in only one of two neighbouring reached coarse cells."""
    known = np.flatnonzero(arcs.covered > 0.0)
    if not known.size:
        return Faces(np.zeros((0, 2, 2)), np.zeros((0, 2)))
    at, width = _compared(grid, arcs, known)
    yield
    covers = np.zeros((len(known), COMPARED), dtype=bool)
    for first in range(0, len(known), TOGETHER):
        some = slice(first, first + TOGETHER)
        covers[some] = arcs.holds(known[some, None], at[None, :])
        yield
    edges, spans = [np.zeros((0, 2, 2))], [np.zeros((0, 2))]
    for axis in range(1 if grid.flat else 2):
        here, beside = _neighbours(grid, known, axis)
        yield
        for first in range(0, len(here), TOGETHER):
            some = slice(first, first + TOGETHER)
            pair, k = np.nonzero(covers[here[some]] != covers[beside[some]])
            edges.append(_sides(grid, known[here[some][pair]], axis))
            spans.append(np.stack([at[k] - 0.5 * width, at[k] + 0.5 * width], axis=1))
            yield
    return Faces(np.concatenate(edges), np.concatenate(spans))


def _compared(grid: Grid, arcs: Arcs, known: Indices) -> tuple[Floats, float]:
    """Return the values of s at which coverage is compared, and the distance between them."""
    low, high = -math.pi, math.pi
    if not grid.joint.revolute:
        start, length = arcs.start[known], arcs.length[known]
        used = length >= 0.0
        low, high = float(start[used].min()), float((start + length)[used].max())
    width = (high - low) / COMPARED or 1.0
    return np.asarray(low + width * (np.arange(COMPARED) + 0.5)), width


def _neighbours(grid: Grid, known: Indices, axis: int) -> tuple[Indices, Indices]:
    """Return pairs of coarse cells that are neighbours along an axis, by their places, in ascending order."""
    columns = -(-grid.shape[1] // grid.coarser)
    wanted = known + (columns if axis == 0 else 1)
    at = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
    pairs = known[at] == wanted
    if axis == 1:
        pairs &= wanted % columns != 0
    here = np.flatnonzero(pairs)
    return here, at[here]


def _sides(grid: Grid, cells: Indices, axis: int) -> Floats:
    """Return both ends (k, 2, 2) of the side between coarse cells and their next neighbours along an axis."""
    i, j = np.divmod(cells, -(-grid.shape[1] // grid.coarser))
    side, low = grid.coarser * grid.step, grid.low
    begin = np.stack([low[0] + side * (i + 1 - axis), low[1] + side * (j + axis)], axis=1)
    step = np.array([0.0, side] if axis == 0 else [side, 0.0])
    if grid.flat:
        begin[:, 1], step = grid.v[0], np.zeros(2)
    return np.stack([begin, begin + step], axis=1)
