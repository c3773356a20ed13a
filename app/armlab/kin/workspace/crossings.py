"""Crossings of the boundary of a section with the lines between cell centres, found by inverse kinematics."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.filling import PULLED, Filling
from armlab.kin.workspace.pull import pieces, pull
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

HALVINGS = {False: 6, True: 12}
"""Number of halvings of a line between two centres when the boundary is looked for, by whether the grid is flat: then
there are few crossings, and they alone make the error."""

REACHED = 1.0 / 64.0
"""Distance from a point, as a fraction of the error of a crossing, at which it is reached. A point that is only nearly
reached counts as outside, and moves no crossing."""


def fineness(grid: Grid) -> float:
    """Return the largest error of a crossing, in cells."""
    return float(0.5 ** HALVINGS[grid.flat])


class Crossings:
    """Crossings of the boundary with the lines between neighbouring centres.

    Attributes
    ----------
    inside : ndarray, shape (Nu, Nv)
        Whether the centre of a cell is reached.
    along_u, along_v : ndarray, shape (Nu - 1, Nv), (Nu, Nv - 1)
        Position of the boundary between a centre and the next, 0 to 1; 0 when it is not between them.
    """

    def __init__(self, filling: Filling) -> None:
        rows, columns = filling.grid.shape
        self.filling = filling
        self.inside = filling.centred.reshape(rows, columns).copy()
        # Zeros are there at once, however many: of a large grid others would take a tenth of a second.
        self.along_u = np.zeros((max(rows - 1, 0), columns))
        self.along_v = np.zeros((rows, max(columns - 1, 0)))

    def find(self) -> Iterator[None]:
        """Find all crossings, a piece of work at a time."""
        for axis, where in ((0, self.along_u), (1, self.along_v)):
            first, second = (
                (self.inside[:-1], self.inside[1:]) if axis == 0 else (self.inside[:, :-1], self.inside[:, 1:])
            )
            yield
            i, j = np.divmod(np.flatnonzero(first != second), first.shape[1])
            yield
            forward = first[i, j]
            columns = self.inside.shape[1]
            low = i * columns + j
            high = low + (columns if axis == 0 else 1)
            reached = np.where(forward, low, high)
            beyond = np.where(forward, high, low)
            for some in pieces(self.filling.joint, len(i), PULLED):
                for part in self._part(reached[some], beyond[some]):
                    if part is None:
                        yield
                        continue
                    where[i[some], j[some]] = np.where(forward[some], part, 1.0 - part)
        yield

    def _part(self, reached: Indices, beyond: Indices) -> Iterator[Floats | None]:
        """Yield None after each piece of work, and at last fractions (k,) of the way from reached centres to others."""
        filling = self.filling
        a, b = filling.grid.centres(reached), filling.grid.centres(beyond)
        low, high = np.zeros(len(a)), np.ones(len(a))
        q, kept = filling.at(reached), filling.row[reached]
        others = [(filling.at(beyond), filling.filled[beyond])]
        others += [(filling.spare[k][kept], filling.has_spare[k, reached]) for k in range(len(filling.spare))]
        tolerance = REACHED * fineness(filling.grid) * filling.grid.step
        for _ in range(HALVINGS[filling.grid.flat]):
            middle = 0.5 * (low + high)
            targets = a + middle[:, None] * (b - a)
            there = np.zeros(len(a), dtype=bool)
            for starts, exist in [(q, np.ones(len(a), dtype=bool)), *others]:
                rows = np.flatnonzero(exist & ~there)
                if not rows.size:
                    continue
                found, error = pull(filling.joint, starts[rows], targets[rows], tolerance)
                good = error <= tolerance
                q[rows[good]] = found[good]
                there[rows[good]] = True
                yield None
            low, high = np.where(there, middle, low), np.where(there, high, middle)
        if filling.around is not None:
            filling.add(q)
        yield 0.5 * (low + high)
