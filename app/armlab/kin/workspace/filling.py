"""Fills the cells of a section: from samples, then by inverse kinematics from cell to cell until nothing more is found.

A cell is filled by a configuration whose point lies in it, never by its neighbours. Where inverse kinematics reaches
its centre as well it is centred, and the boundary runs between centred cells and others.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.around import Around
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.pull import pieces, pull
from armlab.kin.workspace.rows import ROOM, Rows
from armlab.kin.workspace.section_grid import Grid, random_configurations

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Indices32 = NDArray[np.int32]
Bools = NDArray[np.bool_]

SAMPLED = 16384
"""Samples in one piece of work."""

PULLED = 1024
"""Configurations pulled in one piece of work: some 20 ms."""

SPARE = 3
"""Further configurations kept for each cell: other branches may go on where the first one ends."""

AT_CENTRE = 1e-3
"""Distance from the centre of a cell, in cells, at which it is reached."""

TRIES = 3
"""Number of neighbours from which an empty cell is tried at a time."""

SWEEPS = 2
"""Number of times that all cells at the edge are tried from everything known around them."""

SHIFTS = ((-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (-1, 1), (1, -1), (1, 1))


class Filling:
    """Cells of a section as they are filled.

    Attributes
    ----------
    grid : Grid
    filled, centred : ndarray, shape (cells,)
    row : ndarray, shape (cells,)
        Row of a filled cell in the arrays that follow; -1 for others, which are most in a thin region.
    q : Rows of shape (n,)
        A configuration of each filled cell with q_1 = 0, rad and m.
    spare : list of Rows of shape (n,)
        Further ones.
    has_spare : ndarray, shape (SPARE, cells)
        Whether further configurations are kept of a cell.
    around : Around or None
        The covered values of s; None when joint 1 turns all the way round.
    """

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        self.joint: FirstJoint = grid.joint
        cells, n = grid.shape[0] * grid.shape[1], grid.joint.arm.n
        self.filled: Bools = np.zeros(cells, dtype=bool)
        self.centred: Bools = np.zeros(cells, dtype=bool)
        self.row = np.full(cells, -1, dtype=np.int32)
        self.count = 0
        self.q = Rows((n,), ROOM // n)
        self.spare = [Rows((n,), ROOM // n) for _ in range(SPARE)]
        self.has_spare: Bools = np.zeros((SPARE, cells), dtype=bool)
        self.around = None if grid.joint.full else Around(grid)
        self._tried: Bools = np.zeros((len(SHIFTS), cells), dtype=bool)
        self._turn = 0
        self._copies: tuple[Bools, Indices32, Floats] | None = None

    def at(self, cells: Indices) -> Floats:
        """Return the configurations in cells (k,), shape (k, n); arbitrary values for cells that are not filled."""
        return np.asarray(self.q[self.row[cells]])

    def add(self, q: Floats) -> None:
        """Add configurations (k, n), each to the cell in which it falls."""
        self._copies = None
        coordinates = self.joint.split(self.joint.arm.position(q))
        cells, on = self.grid.cell_of(coordinates[:, :2])
        cells, q, s = cells[on], q[on], coordinates[on, 2]
        if self.around is not None:
            self.around.add(cells, s, q)
        fresh = ~self.filled[cells]
        self._give_rows(np.unique(cells[fresh]))
        rows = self.row[cells]
        turn = self._turn = (self._turn + 1) % SPARE
        self.spare[turn][rows] = q
        self.has_spare[turn, cells] = True
        self.q[rows[fresh]] = q[fresh]

    def copies(self) -> tuple[Bools, Indices32, Floats]:
        """Return copies of ``filled``, ``row`` and ``q``; the same ones until something is added."""
        if self._copies is None:
            self._copies = self.filled.copy(), self.row.copy(), self.q.first(self.count)
        return self._copies

    def finished(self) -> tuple[Bools, Indices32, Floats]:
        """Return ``filled``, ``row`` and ``q`` when nothing more will be added; the first two are not copied."""
        return self.filled, self.row, self.q.first(self.count)

    def _give_rows(self, fresh: Indices) -> None:
        self.filled[fresh] = True
        self.row[fresh] = self.count + np.arange(len(fresh), dtype=np.int32)
        self.count += len(fresh)

    def take(self, q: Floats) -> Iterator[None]:
        """Add configurations (k, n), a piece of work at a time."""
        for first in range(0, len(q), SAMPLED):
            self.add(q[first : first + SAMPLED])
            yield

    def sample(self, count: int, rng: np.random.Generator) -> Iterator[None]:
        """Fill cells from random configurations, a piece of work at a time."""
        for _ in range(-(-count // SAMPLED)):
            self.add(random_configurations(self.joint, SAMPLED, rng))
            yield

    def flood(self) -> Iterator[None]:
        """Fill the neighbours of filled cells until none can be filled, a piece of work at a time."""
        while True:
            cells, starts = yield from self._untried()
            if not cells.size:
                return
            yield from self._pull(cells, starts)

    def centre(self) -> Iterator[None]:
        """Pull the configurations of cells to their centres."""
        cells = np.flatnonzero(self.filled & ~self.centred)
        yield
        yield from self._pull(cells, self.at(cells))

    def sweep(self, rng: np.random.Generator) -> Iterator[None]:
        """Try cells at the edge, and filled ones whose centre is not reached, from everything known around them."""
        for shift in SHIFTS:
            found, starts = [], []
            for k in range(SPARE):
                cells, neighbours = self._neighbours(shift, ~self.centred, self.has_spare[k])
                start = self.spare[k][self.row[neighbours]]
                found.append(cells)
                starts.append(self._shaken(start, rng) if k == SPARE - 1 else start)
                yield
            yield from self._pull(np.concatenate(found), np.concatenate(starts))

    def _shaken(self, q: Floats, rng: np.random.Generator) -> Floats:
        """Return configurations near q, inside the limits: away from singularities, and along self-motions."""
        moving = list(self.joint.moving)
        low, high = self.joint.arm.limits[moving].T
        shaken = q.copy()
        by = 0.1 * np.minimum(high - low, 1.0) * rng.standard_normal((len(q), len(moving)))
        shaken[:, moving] = np.clip(q[:, moving] + by, low, high)
        return shaken

    def _pull(self, cells: Indices, starts: Floats) -> Iterator[None]:
        for some in pieces(self.joint, len(cells), PULLED):
            waiting = ~self.centred[cells[some]]
            target = cells[some][waiting]
            q, error = pull(self.joint, starts[some][waiting], self.grid.centres(target), AT_CENTRE * self.grid.step)
            self.add(q)
            there = error <= AT_CENTRE * self.grid.step
            self.q[self.row[target[there]]] = q[there]
            self.centred[target[there]] = True
            self._copies = None
            yield

    def _neighbours(self, shift: tuple[int, int], of: Bools, beside: Bools) -> tuple[Indices, Indices]:
        """Return cells of one kind and their neighbours in a direction that are of another kind."""
        (rows, columns), (di, dj) = self.grid.shape, shift
        # A thin section has few filled cells among many: only these are examined.
        i, j = np.divmod(np.flatnonzero(beside), columns)
        on = (i >= di) & (i < rows + di) & (j >= dj) & (j < columns + dj)
        i, j = i[on], j[on]
        neighbours = i * columns + j
        cells = neighbours - di * columns - dj
        some = of[cells]
        return cells[some], neighbours[some]

    def _untried(self) -> Generator[None, None, tuple[Indices, Floats]]:
        """Return, in pieces of work, empty cells and configurations of neighbours: each pair once, few per cell."""
        tries = np.zeros(len(self.filled), dtype=np.int8)
        cells_found, starts = [], []
        for k, shift in enumerate(SHIFTS):
            cells, neighbours = self._neighbours(shift, ~self.filled, self.filled)
            chosen = ~self._tried[k, cells] & (tries[cells] < TRIES)
            cells, neighbours = cells[chosen], neighbours[chosen]
            self._tried[k, cells] = True
            tries[cells] += 1
            cells_found.append(cells)
            starts.append(self.at(neighbours))
            yield
        return np.concatenate(cells_found), np.concatenate(starts)
