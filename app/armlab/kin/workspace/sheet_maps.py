"""Maps on the surface in which an arm is shown: orientations that were met, and numbers of solutions."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.half_plane import HalfPlane
from armlab.kin.workspace.sheet import CHUNK, Sheet
from armlab.kin.workspace.solution_count import counts
from armlab.kin.workspace.whole_plane import WholePlane

Floats = NDArray[np.float64]

NOTHING = -1
"""Cell of a point outside a map."""


@dataclass(frozen=True, eq=False)
class SheetMap:
    """Values in the cells of a surface.

    Attributes
    ----------
    sheet : Sheet
    low : ndarray, shape (2,)
        Corner in the coordinates of the surface, metres.
    step : float
        Edge of a cell, metres.
    values : ndarray, shape (U, V)
        Fraction of the orientations that were met, or number of solutions inside the limits; nan where nothing was met
        or there is no solution.
    q : ndarray of float32, shape (U, V, n)
        A configuration with the tool point in the cell; nan without.
    done : float
        0 to 1.
    proven : bool
        Whether each number of solutions is known to be all; a sampled map never is.
    """

    sheet: Sheet
    low: Floats
    step: float
    values: Floats
    q: NDArray[np.float32]
    done: float
    proven: bool

    def cell(self, point: ArrayLike) -> tuple[int, int] | None:
        """Return the cell of a point (3,) in the world, wherever joint 1 carries it; None outside."""
        place = np.floor((self.sheet.places(point) - self.low) / self.step).astype(int)
        inside = np.all((place >= 0) & (place < self.values.shape))
        return (int(place[0]), int(place[1])) if inside else None


def sheet_of(arm: Arm, s: float) -> Sheet:
    """Return the plane of a planar arm, else the half plane at s, rad or m (`HalfPlane`)."""
    joint = first_joint(arm)
    if not joint.planar:
        return HalfPlane(arm, s)
    plane = WholePlane(arm, 0.0)
    point = arm.position(arm.limits.mean(axis=1))
    return WholePlane(arm, float((np.asarray(point) - joint.origin) @ plane.across[:, 2]))


def approach_maps(sheet: Sheet, count: int, cells: int, seed: int = 0) -> Iterator[SheetMap]:
    """Yield the fraction of the orientations that were met in each cell, after each piece of work of some 10 ms.

    Parameters
    ----------
    sheet : Sheet
    count : int
        Random configurations.
    cells : int
        Along the longer side.
    seed : int
    """
    grid, n = sheet.grid(cells), sheet.arm.n
    q = np.full((math.prod(grid.shape), n), np.nan, dtype=np.float32)
    tried = 0
    for met in sheet.samples(count, seed):
        tried = min(tried + CHUNK, count)
        found = grid.add(met.places, met.axes)
        inside = found != NOTHING
        # Any of several configurations in a cell will do; the first one stays, so that a click keeps its meaning.
        fresh = np.flatnonzero(inside & np.isnan(q[found, 0]))
        q[found[fresh]] = met.q[fresh]
        share = np.where(grid.counts > 0, grid.coverage, np.nan)
        yield SheetMap(sheet, grid.low, grid.step, share, q.reshape(*grid.shape, n), tried / count, False)


def count_maps(sheet: Sheet, R: ArrayLike, cells: int) -> Iterator[SheetMap]:
    """Yield how many solutions inside the limits there are in the middle of each cell, after each column of cells.

    Parameters
    ----------
    sheet : Sheet
    R : array_like, shape (3, 3)
        Orientation of the tool in the world, the same everywhere.
    cells : int
        Along the longer side.
    """
    grid, arm = sheet.grid(cells), sheet.arm
    columns, rows = grid.shape
    values, proven = np.full(grid.shape, np.nan), True
    nowhere = np.full((columns, rows, arm.n), np.nan, dtype=np.float32)
    v = grid.low[1] + (np.arange(rows) + 0.5) * grid.step
    for i in range(columns):
        u = np.full(rows, grid.low[0] + (i + 0.5) * grid.step)
        for j, count in enumerate(counts(arm, sheet.points(np.stack([u, v], axis=-1)), R)):
            proven = proven and count.complete
            if count.inside > 0:
                values[i, j] = count.inside
            if j % _SOLVES == _SOLVES - 1:
                yield SheetMap(sheet, grid.low, grid.step, values.copy(), nowhere, (i + j / rows) / columns, proven)
        yield SheetMap(sheet, grid.low, grid.step, values.copy(), nowhere, (i + 1) / columns, proven)


_SOLVES = 8
"""Number of inverse kinematics problems solved in one piece of work."""
