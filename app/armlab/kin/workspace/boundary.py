"""The boundary of a workspace: which points are inside, and the distance of a point from the boundary.

The boundary is the outline of the section carried round (or along) by joint 1 and, where joint 1 is limited, the walls
at which it ends.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.work import Work, result_of
from armlab.kin.workspace.around import Arcs
from armlab.kin.workspace.faces import Faces, finding_faces
from armlab.kin.workspace.met import BINS
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

ON_AXIS = 1e-9
"""Distance from the axis of joint 1, in cells, below which an edge of the section is no boundary."""

SPANNED = 1 << 18
"""Pairs of a point and an edge at its height that are examined together: they limit the memory."""

WALLS = 16
"""Number of coarse cells, the nearest at the walls of joint 1, in whose finer cells the foot is looked for."""


class To(NamedTuple):
    """The way to the boundary.

    Attributes
    ----------
    distance : float
        Metres; positive inside, negative outside, infinite where there is no boundary.
    foot : ndarray, shape (3,)
        The nearest point of the boundary in the world, metres.
    """

    distance: float
    foot: Floats


class Boundary:
    """The boundary of a section; each part is computed at first use, or before that in pieces (`preparing`)."""

    def __init__(self, grid: Grid, outline: Outline, arcs: Arcs | None, filled: Bools) -> None:
        self.grid, self.outline, self.arcs, self.filled = grid, outline, arcs, filled
        self.joint = grid.joint

    @cached_property
    def contours(self) -> tuple[Floats, ...]:
        """Closed polylines (k, 2) in (u, v), metres."""
        if not self.grid.flat:
            found = with_axis(self.outline, self.grid).contours
            large = tuple(found[k] for k in np.flatnonzero(np.abs(enclosed(found)) >= self.grid.step**2))
            # A line smaller than a cell is more likely a missed cell; a thin region consists of nothing else.
            return large or found
        v = self.grid.v[0]
        return tuple(np.array([[a, v], [b, v], [a, v]]) for a, b in self.spans)

    @cached_property
    def spans(self) -> Floats:
        """Intervals of u that a planar arm reaches, shape (k, 2), metres."""
        inside, u = self.outline.inside[:, 0], self.outline.u
        cuts = np.flatnonzero(inside[:-1] != inside[1:])
        at = u[cuts] + self.outline.along_u[cuts, 0] * (u[cuts + 1] - u[cuts])
        if inside.size and inside[0]:
            at = np.concatenate([[0.0], at])
        return np.asarray(at[: len(at) // 2 * 2].reshape(-1, 2))

    @cached_property
    def edges(self) -> tuple[Floats, Floats]:
        """Begins and ends of the pieces of the outline, (k, 2) each, without those on the axis of joint 1."""
        if self.grid.flat:
            ends = self.spans.reshape(-1)
            a = np.stack([ends, np.full_like(ends, self.grid.v[0])], axis=1)
            b = a.copy()
        else:
            a = np.concatenate([np.zeros((0, 2)), *(line[:-1] for line in self.contours)])
            b = np.concatenate([np.zeros((0, 2)), *(line[1:] for line in self.contours)])
        # A line, a surface, or what is thinner than a cell has no inside; all of it is its boundary.
        alone = self.grid.centres(np.flatnonzero(lonely(self.filled, self.outline.inside)))
        a, b = np.concatenate([a, alone]), np.concatenate([b, alone])
        beside = self.grid.at_axis & (np.maximum(a[:, 0], b[:, 0]) <= ON_AXIS * self.grid.step)
        return a[~beside], b[~beside]

    @cached_property
    def edge_cells(self) -> Indices:
        """Coarse cell of each piece of the outline, in which its s is looked up."""
        a, b = self.edges
        rows, columns = self.filled.shape
        place = 0.5 * (a + b)
        i0 = np.floor((place[:, 0] - self.grid.u[0]) / self.grid.step).astype(np.intp)
        j0 = np.floor((place[:, 1] - self.grid.v[0]) / self.grid.step).astype(np.intp)
        cells = np.zeros(len(a), dtype=np.intp)
        # One of the four centres round it is inside.
        for di, dj in ((0, 0), (1, 0), (0, 1), (1, 1)):
            i, j = np.clip(i0 + di, 0, rows - 1), np.clip(j0 + dj, 0, columns - 1)
            cells = np.where(self.filled[i, j], self._coarse(i, j), cells)
        return cells

    @cached_property
    def walls(self) -> tuple[Floats, Floats, Floats]:
        """Ends of the range of joint 1 in each coarse cell: points (k, 3) in the world, their (u, v) and their s."""
        arcs = self.arcs
        assert arcs is not None
        cells = np.unique(self._coarse(*np.nonzero(self.filled)))
        used = (arcs.length[cells] >= 0.0) & (arcs.length[cells] < arcs.period)
        where, which = np.nonzero(used)
        begin = arcs.start[cells[where], which]
        s = np.concatenate([begin, begin + arcs.length[cells[where], which]])
        side = self.grid.coarser * self.grid.step
        i, j = np.divmod(cells[where], -(-self.grid.shape[1] // self.grid.coarser))
        u = self.grid.low[0] + side * (i + 0.5)
        v = np.full(len(u), self.grid.v[0]) if self.grid.flat else self.grid.low[1] + side * (j + 0.5)
        uv = np.tile(np.stack([u, v], axis=1), (2, 1))
        return self.joint.join(np.column_stack([uv, s])), uv, s

    @cached_property
    def faces(self) -> Faces:
        """Faces where s is covered in only one of two neighbouring coarse cells."""
        assert self.arcs is not None
        return result_of(finding_faces(self.grid, self.arcs))

    @cached_property
    def _face_points(self) -> Floats:
        edges, spans = self.faces
        return self.joint.join(np.column_stack([edges.mean(axis=1), spans.mean(axis=1)]))

    def preparing(self) -> Work[None]:
        """Compute in advance what `distance` needs, in pieces of at most some 30 ms."""
        for name in ("contours", "edges", "edge_cells"):
            getattr(self, name)
            yield
        if self.arcs is None:
            return
        _ = self.walls
        yield
        if "faces" not in self.__dict__:
            self.faces = yield from finding_faces(self.grid, self.arcs)
        yield
        _ = self._face_points

    def holds(self, points: Floats) -> Bools:
        """Return a mask of the points of the world (..., 3) that are inside."""
        coordinates = self.joint.split(points)
        uv = coordinates[..., :2]
        inside = self._in_outline(uv)
        if self.arcs is None:
            return inside
        return np.asarray(inside & self.arcs.holds(self._cells(uv), coordinates[..., 2]))

    def distance(self, point: Floats) -> To:
        """Return the shortest way to the boundary from a point of the world (3,)."""
        u, v, s = self.joint.split(point)
        candidates = [self._to_edges(u, v, s)]
        if self.arcs is not None:
            candidates += [self._to_walls(point, u, v, s), self._to_faces(point)]
        nearest = min(candidates, key=lambda to: to.distance)
        return nearest if self.holds(point) else To(-nearest.distance, nearest.foot)

    def _to_edges(self, u: float, v: float, s: float) -> To:
        a, b = self.edges
        if self.arcs is not None:
            covers = self.arcs.holds(self.edge_cells, np.full(len(a), s))
            a, b = a[covers], b[covers]
        if not len(a):
            return To(math.inf, np.full(3, np.nan))
        p = np.array([u, self.grid.v[0] if self.grid.flat else v])
        along = b - a
        square = np.einsum("ij,ij->i", along, along)
        t = np.clip(np.einsum("ij,ij->i", p - a, along) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
        feet = a + t[:, None] * along
        away = np.hypot(*(feet - p).T)
        k = int(np.argmin(away))
        off = abs(v - self.grid.v[0]) if self.grid.flat else 0.0
        return To(math.hypot(float(away[k]), off), self.joint.join([*feet[k], s]))

    def _to_walls(self, point: Floats, u: float, v: float, s: float) -> To:
        points, uv, at = self.walls
        if not len(points):
            return To(math.inf, np.full(3, np.nan))
        away = np.linalg.norm(points - point, axis=1)
        some = np.argsort(away)[:WALLS]
        # Near there the wall runs on at the same s: the foot need not be the centre of a cell.
        foot = np.array([u, self.grid.v[0] if self.grid.flat else v, at[some[0]]])
        if self.joint.revolute:
            foot[0] = max(u * math.cos(s - at[some[0]]), 0.0)
        if not self._on_wall(foot):
            foot = self._foot_in(uv[some], at[some], point, foot)
        place = self.joint.join(foot)
        return To(float(np.linalg.norm(place - point)), place)

    def _to_faces(self, point: Floats) -> To:
        points = self._face_points
        if not len(points):
            return To(math.inf, np.full(3, np.nan))
        away = np.linalg.norm(points - point, axis=1)
        k = int(np.argmin(away))
        return To(float(away[k]), points[k])

    def _foot_in(self, uv: Floats, at: Floats, point: Floats, foot: Floats) -> Floats:
        """Return the place of a wall nearest to a point, among the filled cells of some coarse cells with their s."""
        step, steps = self.grid.step, (np.arange(self.grid.coarser) - 0.5 * (self.grid.coarser - 1)) * self.grid.step
        du, dv = (each.reshape(-1) for each in np.meshgrid(steps, [0.0] if self.grid.flat else steps))
        fine = uv[:, None, :] + np.stack([du, dv], axis=1)
        cells, on = self.grid.cell_of(fine)
        filled = on & self.filled.reshape(-1)[np.where(on, cells, 0)]
        k, m = np.nonzero(filled)
        if not len(k):
            return np.array([*uv[0], at[0]])
        candidates = np.column_stack([fine[k, m], at[k]])
        nearest = candidates[np.argmin(np.linalg.norm(self.joint.join(candidates) - point, axis=1))]
        wanted = np.clip(foot[:2], nearest[:2] - 0.5 * step, nearest[:2] + 0.5 * step)
        return np.array([*(wanted if nearest[2] == foot[2] else nearest[:2]), nearest[2]])

    def _on_wall(self, foot: Floats) -> bool:
        """Return whether the range of joint 1 ends at (u, v) with about the s of (u, v, s)."""
        assert self.arcs is not None
        cells, on = self.grid.cell_of(foot[:2])
        if not on or not self.filled.reshape(-1)[cells]:
            return False
        coarse = self._coarse(*np.divmod(cells, self.grid.shape[1]))
        start, length = self.arcs.start[coarse], self.arcs.length[coarse]
        ends = np.concatenate([start, start + length])[np.tile(length >= 0.0, 2)]
        off = np.abs(ends - foot[2])
        if self.joint.revolute:
            off = np.abs(np.remainder(ends - foot[2] + math.pi, math.tau) - math.pi)
        near = math.tau / BINS if self.joint.revolute else self.grid.coarser * self.grid.step
        return bool((off <= near).any())

    def _in_outline(self, uv: Floats) -> Bools:
        """Return whether points (..., 2) lie in the polygons of the squares between centres."""
        if self.grid.flat:
            near = np.searchsorted(self.spans.reshape(-1), uv[..., 0]) % 2 == 1
            level = np.abs(uv[..., 1] - self.grid.v[0]) <= self.grid.step
            return np.asarray(near & level)
        return inside_polygons(uv, self.contours)

    def _cells(self, uv: Floats) -> Indices:
        cells, _ = self.grid.cell_of(uv)
        return self._coarse(*np.divmod(cells, self.grid.shape[1]))

    def _coarse(self, i: Indices, j: Indices) -> Indices:
        return np.asarray(i // self.grid.coarser * -(-self.grid.shape[1] // self.grid.coarser) + j // self.grid.coarser)


def with_axis(outline: Outline, grid: Grid) -> Outline:
    """Return the region extended to the axis of joint 1, which is no boundary; the outline itself when that is far."""
    if not grid.at_axis:
        return outline
    first = outline.inside[:1]
    columns = first.shape[1]
    return Outline(
        np.concatenate([[0.0, 0.0], outline.u]),
        outline.v,
        np.concatenate([np.zeros_like(first), first, outline.inside]),
        np.concatenate([np.ones((1, columns)), np.full((1, columns), 0.5), outline.along_u]),
        np.concatenate([outline.along_v[:1], outline.along_v[:1], outline.along_v]),
    )


def lonely(filled: Bools, inside: Bools) -> Bools:
    """Return the filled cells with no inner centre beside them, both arrays of shape (Nu, Nv)."""
    wide = np.pad(inside, 1)
    near = np.zeros_like(filled)
    rows, columns = filled.shape
    for i in range(3):
        for j in range(3):
            near |= wide[i : i + rows, j : j + columns]
    return np.asarray(filled & ~near)


def enclosed(lines: tuple[Floats, ...]) -> Floats:
    """Return the areas inside closed polylines (k, 2), one for each, positive when they run counter-clockwise."""
    if not lines:
        return np.zeros(0)
    u, v = np.concatenate(lines).T
    ends = np.cumsum([len(line) for line in lines])
    cross = u * np.roll(v, -1) - np.roll(u, -1) * v
    # From the last point of a line nothing leads on to the next line.
    cross[ends - 1] = 0.0
    return 0.5 * np.add.reduceat(cross, np.concatenate([[0], ends[:-1]]))


def inside_polygons(uv: Floats, contours: tuple[Floats, ...]) -> Bools:
    """Return which points (..., 2) are inside closed polylines: an odd number of edges lies beyond them along u."""
    given = uv.reshape(-1, 2)
    beyond = np.zeros(len(given), dtype=np.intp)
    if not contours:
        return np.zeros(uv.shape[:-1], dtype=bool)
    a = np.concatenate([line[:-1] for line in contours])
    b = np.concatenate([line[1:] for line in contours])
    order = np.argsort(given[:, 1])
    u, v = given[order].T
    # An edge spans the points from its lower end, itself counted, to its upper one.
    first = np.searchsorted(v, np.minimum(a[:, 1], b[:, 1]))
    count = np.searchsorted(v, np.maximum(a[:, 1], b[:, 1])) - first
    before = np.cumsum(count) - count
    for begin in range(0, int(count.sum()), SPANNED):
        pairs = np.arange(begin, min(begin + SPANNED, int(count.sum())))
        edge = np.searchsorted(before, pairs, side="right") - 1
        point = first[edge] + pairs - before[edge]
        crossing = a[edge, 0] + (v[point] - a[edge, 1]) * (b[edge, 0] - a[edge, 0]) / (b[edge, 1] - a[edge, 1])
        beyond += np.bincount(order[point[crossing > u[point]]], minlength=len(given))
    return np.asarray(beyond % 2 == 1).reshape(uv.shape[:-1])
