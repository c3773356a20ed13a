"""The size of a workspace from random points in space, each tried by inverse kinematics from the nearest samples.

What is said of the size is wrong by what is said wrongly of the points: so points are drawn where the section is less
sure, and elsewhere a few, and the size is corrected by those on which the two disagree. The correction has no bias,
however good or bad the section is; its error is that of a mean of random numbers. Where one number tells all (the
distance from the axis, of a planar arm that turns all the way round), its ends are found by samples alone.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from armlab.kin.workspace.pull import pull_in_space
from armlab.kin.workspace.section import Section

POOL, NEAREST, ANY = 400_000, 20, 12
"""Random configurations, how many of them are tried for a point, and how many of them wherever their tool point is."""

DRAWN, TRIED = 200_000, {"unsure": 5000, "sure": 1500}
"""Points that tell how much is near the boundary, and points that are tried."""

WIDE, FAR = 2, 8
"""Cells from the boundary that are less sure, and from what is reached in which points are drawn at all."""

REACHED = 1e-6
"""Of the reach: as near to a point as that is there."""

ENDS = 100
"""Rounds of samples that look for the ends of one number."""


class Judged(NamedTuple):
    """A size in m³ or m², and how far it may be off: two standard deviations."""

    value: float
    error: float


def judged(section: Section, effort: float = 1.0, seed: int = 0) -> Judged:
    """Return the size of the workspace of which a section says more or less where it is."""
    rng = np.random.default_rng(seed)
    if section.grid.flat and section.joint.full:
        return _between_ends(section, rng)
    pool = _Pool(section, rng, int(POOL * max(effort, 0.1)))
    tried = _Points(section, pool.points, rng)
    value, variance = tried.said, 0.0
    coordinates, volume = tried.drawn(int(DRAWN * max(effort, 0.1)))
    unsure = tried.unsure(coordinates)
    for kind, here in (("unsure", unsure), ("sure", ~unsure)):
        some = np.flatnonzero(here)[: int(TRIED[kind] * effort)]
        if not some.size:
            continue
        points = section.joint.join(coordinates[some])
        wrong = pool.reached(points).astype(float) - tried.says(coordinates[some])
        part = volume * here.mean()
        value += part * wrong.mean()
        # One more point that might have been wrong: none among so many is no proof.
        spread = wrong.var() + 1.0 / len(wrong) ** 2
        variance += part**2 * spread / len(wrong)
    return Judged(float(value), 2.0 * math.sqrt(variance))


class _Points:
    """Points about a section, and what its cells say of them."""

    def __init__(self, section: Section, met: np.ndarray, rng: np.random.Generator) -> None:
        self.section, self.grid, self.joint, self.rng = section, section.grid, section.joint, rng
        inside = section.outline.inside
        self.inside = inside
        self.edge = self._spread(inside, WIDE) & ~self._shrunk(inside, WIDE)
        # Points are drawn about what is said to be reached, and wherever a sample was met.
        hit, on = self.grid.cell_of(self.joint.split(met)[:, :2])
        drawn = self._spread(inside | section.filled, FAR)
        drawn.reshape(-1)[hit[on]] = True
        self.where = np.flatnonzero(self._spread(drawn, 1))
        covered = np.where(inside, section.covered, 0.0)
        path = self.joint.measure(section.u)[:, None]
        self.said = float((path * covered).sum()) * self.grid.step ** (1 if self.grid.flat else 2)
        self.span = (-math.pi, math.pi)
        if not self.joint.revolute:
            arcs = section.arcs
            used = arcs.length > 0.0
            low_s, high_s = float(arcs.start[used].min()), float((arcs.start + arcs.length)[used].max())
            more = 0.1 * (high_s - low_s)
            self.span = (low_s - more, high_s + more)

    def _spread(self, mask: np.ndarray, by: int) -> np.ndarray:
        """Return cells within so many of some, along rows and columns."""
        found = mask.copy()
        for axis in range(1 if self.grid.flat else 2):
            here = np.moveaxis(found, axis, 0)
            before = here.copy()
            for k in range(1, by + 1):
                here[k:] |= before[:-k]
                here[:-k] |= before[k:]
        return found

    def _shrunk(self, mask: np.ndarray, by: int) -> np.ndarray:
        """Return cells no nearer than that to others; what lies beyond the grid is another."""
        wide = np.pad(mask, ((by, by), (0, 0)) if self.grid.flat else by)
        shrunk = ~self._spread(~wide, by)[by:-by]
        return shrunk if self.grid.flat else shrunk[:, by:-by]

    def drawn(self, count: int) -> tuple[np.ndarray, float]:
        """Return random (u, v, s) spread evenly in space, (count, 3), and the size of where they are."""
        step = self.grid.step
        begin = self.grid.centres(self.where)[:, 0] - 0.5 * step
        sizes = step * (begin + 0.5 * step) if self.joint.revolute else np.full(len(begin), step)
        chosen = self.rng.choice(len(begin), count, p=sizes / sizes.sum())
        r = self.rng.random((count, 3))
        low, high = begin[chosen], begin[chosen] + step
        u = np.sqrt(low**2 + (high**2 - low**2) * r[:, 0]) if self.joint.revolute else low + step * r[:, 0]
        v = self.grid.centres(self.where[chosen])[:, 1]
        if not self.grid.flat:
            v = v + step * (r[:, 1] - 0.5)
        s = self.span[0] + (self.span[1] - self.span[0]) * r[:, 2]
        volume = float(sizes.sum()) * (1.0 if self.grid.flat else step) * (self.span[1] - self.span[0])
        return np.column_stack([u, v, s]), volume

    def _cells(self, coordinates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        cells, _ = self.grid.cell_of(coordinates[:, :2])
        rows, columns = np.divmod(cells, self.grid.shape[1])
        return cells, rows // self.grid.coarser * -(
            -self.grid.shape[1] // self.grid.coarser
        ) + columns // self.grid.coarser

    def says(self, coordinates: np.ndarray) -> np.ndarray:
        cells, coarse = self._cells(coordinates)
        inside = self.inside.reshape(-1)[cells]
        return inside if self.section.arcs is None else inside & self.section.arcs.holds(coarse, coordinates[:, 2])

    def unsure(self, coordinates: np.ndarray) -> np.ndarray:
        cells, coarse = self._cells(coordinates)
        unsure = self.edge.reshape(-1)[cells]
        if self.section.arcs is None:
            return unsure
        shape = [-(-n // self.grid.coarser) for n in self.grid.shape]
        i, j = np.divmod(coarse, shape[1])
        known = self.section.arcs.covered > 0.0
        here = self.section.arcs.holds(coarse, coordinates[:, 2])
        for di in (-1, 0, 1):
            for dj in (-1, 0, 1):
                near = np.clip(i + di, 0, shape[0] - 1) * shape[1] + np.clip(j + dj, 0, shape[1] - 1)
                unsure |= known[near] & (self.section.arcs.holds(near, coordinates[:, 2]) != here)
        return unsure & (known[coarse] | self.edge.reshape(-1)[cells])


class _Pool:
    """Random configurations with their tool points."""

    def __init__(self, section: Section, rng: np.random.Generator, count: int) -> None:
        self.section, self.rng = section, rng
        low, high = section.joint.arm.limits.T
        self.q = low + (high - low) * rng.random((count, len(low)))
        self.points = section.joint.arm.position(self.q)
        self.tree = cKDTree(self.points)

    def reached(self, points: np.ndarray) -> np.ndarray:
        """Return which points (k, 3) are reached inside the limits."""
        arm = self.section.joint.arm
        near = self.tree.query(points, NEAREST)[1]
        tries = np.concatenate([near, self.rng.integers(0, len(self.q), (len(points), ANY))], axis=1)
        found = np.zeros(len(points), dtype=bool)
        for k in range(tries.shape[1]):
            left = np.flatnonzero(~found)
            if not left.size:
                break
            tolerance = REACHED * arm.reach
            _, error = pull_in_space(self.section.joint, self.q[tries[left, k]], points[left], tolerance)
            found[left] = error <= tolerance
        return found


def _between_ends(section: Section, rng: np.random.Generator) -> Judged:
    """Return the area from the ends of the distances, which samples shaken near them push outward."""
    joint, (low, high) = section.joint, section.joint.arm.limits.T
    q = low + (high - low) * rng.random((POOL, len(low)))
    cells = np.zeros(4 * len(section.u), dtype=bool)
    width = (section.u[-1] + section.step) / len(cells)
    ends: dict[tuple[int, int], tuple[float, np.ndarray]] = {}
    scale = 0.3
    for _ in range(ENDS):
        u = joint.split(joint.arm.position(q))[:, 0]
        index = np.minimum((u / width).astype(int), len(cells) - 1)
        cells[index] = True
        edges = np.flatnonzero(np.diff(np.pad(cells, 1).astype(int)))
        keys = [(int(edge) - (k % 2), k % 2) for k, edge in enumerate(edges)]
        kept = {}
        for cell, side in keys:
            here = np.flatnonzero(index == cell)
            best = ends.get((cell, side), (math.inf if side == 0 else -math.inf, None))
            if here.size:
                at = here[np.argmin(u[here]) if side == 0 else np.argmax(u[here])]
                if (u[at] < best[0]) == (side == 0):
                    best = (float(u[at]), q[at].copy())
            kept[cell, side] = best
        ends = kept
        starts = np.array([q_end for _, q_end in ends.values()])
        some = starts[rng.integers(0, len(starts), POOL // 20)]
        shakes = scale * rng.random((len(some), 1)) ** 3 * rng.standard_normal(some.shape) * (high - low)
        q = np.clip(some + shakes * (rng.random(some.shape) < 0.6), low, high)
        scale *= 0.85
    values = [value for value, _ in ends.values()]
    area = math.pi * sum(b * b - a * a for a, b in zip(values[::2], values[1::2], strict=True))
    return Judged(area, 1e-6 * area)
