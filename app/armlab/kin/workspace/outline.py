"""Area, moment and boundary lines of a region that is known at the centres of square cells and where its edge runs.

Every square between four neighbouring centres holds one piece of the region, a polygon through the centres that are
inside and the crossings between an inside and an outside one ("marching squares", with measured crossings).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class Pieces(NamedTuple):
    """Polygons in k squares between centres.

    Attributes
    ----------
    i, j : ndarray, shape (k,)
        Their squares.
    area, moment : ndarray, shape (k,)
        Area, m^2, and its integral of u, m^3.
    """

    i: NDArray[np.intp]
    j: NDArray[np.intp]
    area: Floats
    moment: Floats


@dataclass(frozen=True, eq=False)
class Outline:
    """A region of the (u, v) plane.

    Attributes
    ----------
    u, v : ndarray, shape (Nu,), (Nv,)
        Centres, metres.
    inside : ndarray, shape (Nu, Nv)
    along_u, along_v : ndarray, shape (Nu - 1, Nv), (Nu, Nv - 1)
        Position of the edge of the region between a centre and the next, 0 to 1.
    """

    u: Floats
    v: Floats
    inside: Bools
    along_u: Floats
    along_v: Floats

    @cached_property
    def corners(self) -> tuple[NDArray[np.intp], Floats, Bools]:
        """Squares with a piece of the boundary.

        Returns
        -------
        squares : ndarray, shape (k, 2)
        places : ndarray, shape (k, 8, 2)
            Centres and crossings in turn round a square, metres.
        used : ndarray, shape (k, 8)
            Mask of the points that belong to the polygon.
        """
        counted = self._inside_corners
        squares = np.argwhere((counted & 3) != 0)
        i, j = squares.T
        places, used = np.empty((len(squares), 8, 2)), np.empty((len(squares), 8), dtype=bool)
        ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        for k, (m, n) in enumerate(ring):
            places[:, 2 * k, 0], places[:, 2 * k, 1] = self.u[m], self.v[n]
            used[:, 2 * k] = self.inside[m, n]
        cuts = [(self.along_u, i, j), (self.along_v, i + 1, j), (self.along_u, i, j + 1), (self.along_v, i, j)]
        for k, (along, m, n) in enumerate(cuts):
            # The last two edges are met from their far ends.
            begin, end = (2 * k, (2 * k + 2) % 8) if k < 2 else ((2 * k + 2) % 8, 2 * k)
            t = along[m, n][:, None]
            places[:, 2 * k + 1] = places[:, begin] + t * (places[:, end] - places[:, begin])
            used[:, 2 * k + 1] = used[:, 2 * k] != used[:, (2 * k + 2) % 8]
        return squares, places, used

    @cached_property
    def _inside_corners(self) -> NDArray[np.uint8]:
        """Number of corners of each square that are inside, 0 to 4."""
        counted = self.inside.view(np.uint8)
        return np.asarray(counted[:-1, :-1] + counted[1:, :-1] + counted[:-1, 1:] + counted[1:, 1:])

    @cached_property
    def pieces(self) -> Pieces:
        """The polygon in each square that is not empty; in a thin region these are few."""
        i, j = np.nonzero(self._inside_corners == 4)
        du, dv = np.diff(self.u), np.diff(self.v)
        whole = du[i] * dv[j]
        squares, places, used = self.corners
        # An unused corner coincides with the used one before it, and adds nothing.
        places = places.copy()
        for _ in range(2):
            for k in range(8):
                places[:, k] = np.where(used[:, k, None], places[:, k], places[:, k - 1])
        x, y = places[..., 0] - self.u[squares[:, 0], None], places[..., 1] - self.v[squares[:, 1], None]
        x2, y2 = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
        cross = x * y2 - x2 * y
        part = cross.sum(axis=1) / 2.0
        moment = (cross * (x + x2)).sum(axis=1) / 6.0 + part * self.u[squares[:, 0]]
        return Pieces(
            np.concatenate([i, squares[:, 0]]),
            np.concatenate([j, squares[:, 1]]),
            np.concatenate([whole, part]),
            np.concatenate([whole * 0.5 * (self.u[i + 1] + self.u[i]), moment]),
        )

    @cached_property
    def contours(self) -> tuple[Floats, ...]:
        """Closed polylines (k, 2) along the boundary, first point again at the end, with the region on the left."""
        squares, places, used = self.corners
        edges = self._edges_of(squares)
        steps = []
        for k in (1, 3, 5, 7):
            # Round the square the region begins at a cut that an inside corner follows, and ends at the next cut.
            rows = np.flatnonzero(used[:, k] & used[:, (k + 1) % 8])
            end = np.full(len(rows), k)
            for m in range(k + 8, k + 1, -2):
                end = np.where(used[rows, m % 8], m % 8, end)
            steps.append(np.stack([8 * rows + k, 8 * rows + end, edges[rows, end // 2], edges[rows, k // 2]], axis=1))
        # The boundary leaves each cut once: it enters one of the two squares there, and comes out of the other.
        in_turn = np.concatenate(steps)
        _, cut, begin, end = in_turn[np.argsort(in_turn[:, 0])].T
        by_number, where = np.argsort(begin), places.reshape(-1, 2)[cut]
        onward = dict(zip(begin.tolist(), end.tolist(), strict=True))
        lines = _closed(onward)
        # A region that has just been begun has thousands of lines: they are looked up together.
        numbers = np.fromiter(chain.from_iterable(lines), dtype=np.intp)
        points = where[by_number[np.searchsorted(begin[by_number], numbers)]]
        return tuple(np.split(points, np.cumsum([len(line) for line in lines])[:-1])) if lines else ()

    def _edges_of(self, squares: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return the numbers of the four edges of squares (k, 2) in order; two squares share those between them."""
        i, j = squares.T
        columns, across = self.inside.shape[1], self.inside.size
        along_u, along_v = i * columns + j, across + i * columns + j
        return np.stack([along_u, along_v + columns, along_u + 1, along_v], axis=1)

    def coarser(self) -> Outline:
        """Return the same region, given only at every second centre."""
        inside = self.inside[::2, ::2]
        return Outline(
            self.u[::2],
            self.v[::2],
            inside,
            _joined(self.inside[:, ::2], self.along_u[:, ::2]),
            _joined(self.inside[::2].T, self.along_v[::2].T).T,
        )


def _joined(inside: Bools, along: Floats) -> Floats:
    """Return crossings between every second centre from those between neighbours, along the first axis."""
    n = (len(inside) - 1) // 2
    first, second = along[0 : 2 * n : 2], along[1 : 2 * n : 2]
    in_first = inside[0 : 2 * n : 2] != inside[1 : 2 * n : 2]
    return np.where(in_first, first / 2.0, (1.0 + second) / 2.0)


def _closed(onward: dict[int, int]) -> list[list[int]]:
    """Return the closed lines formed by these steps."""
    lines = []
    for first in list(onward):
        if first not in onward:
            continue
        line = [first]
        while len(line) == 1 or line[-1] != line[0]:
            line.append(onward.pop(line[-1]))
        lines.append(line)
    return lines
