"""The covered values of s, the number that joint 1 changes, at each place of a section.

A place (u, v) is reached at some values of s with q_1 = 0 (left and right shoulder give two; a redundant arm gives
intervals). Joint 1 carries each to all of s + [low, high]. Their union is covered.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.met import BINS, Met, gaps_before
from armlab.kin.workspace.section_grid import FIRST_LOOK, Grid, random_configurations

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

MOST_ARCS = 4
"""Largest number of separate intervals of s kept at one place; of further gaps only the size counts."""


class Around(Met):
    """Collects the values of s at q_1 = 0 with a configuration for each.

    Only coarse cells that were met have room: of a sliver they are few among many.

    Attributes
    ----------
    row : ndarray, shape (C,)
        Row of each coarse cell; -1 for one that was not met.
    """

    def __init__(self, grid: Grid) -> None:
        joint = grid.joint
        super().__init__(joint, (-math.pi, math.pi) if joint.revolute else _span(grid))
        self.grid = grid
        self.width = grid.coarser
        self.shape = tuple(-(-n // self.width) for n in grid.shape)
        self.row = np.full(self.shape[0] * self.shape[1], -1)
        self.known = 0

    def coarse(self, cells: Indices) -> Indices:
        """Return the coarse cells (k,) that contain cells (k,) of the section, as flat indices."""
        columns = self.grid.shape[1]
        return np.asarray((cells // columns) // self.width * self.shape[1] + (cells % columns) // self.width)

    def add(self, cells: Indices, s: Floats, q: NDArray[np.floating]) -> None:
        """Count the values of s (k,) of configurations (k, n) with q_1 = 0 in cells of the section (k,)."""
        coarse = self.coarse(cells)
        fresh = np.unique(coarse[self.row[coarse] < 0])
        self.row[fresh] = self.known + np.arange(len(fresh))
        self.known += len(fresh)
        self.put(self.row[coarse], s, q)

    def arcs(self) -> Arcs:
        """Return the intervals that joint 1 covers."""
        least, most = (np.full((len(self.row), BINS), sign * np.inf) for sign in (1.0, -1.0))
        met = np.flatnonzero(self.row >= 0)
        least[met], most[met] = self.least[self.row[met]], self.most[self.row[met]]
        return arcs_of(least, most, self.joint)


def _span(grid: Grid) -> tuple[float, float]:
    """Return the range of s in which samples were met, m, with a small margin."""
    q = random_configurations(grid.joint, FIRST_LOOK, np.random.default_rng(0))
    s = grid.joint.split(grid.joint.arm.position(q))[:, 2]
    more = 0.05 * float(np.ptp(s)) + grid.step
    return float(s.min()) - more, float(s.max()) + more


@dataclass(frozen=True, eq=False)
class Arcs:
    """The covered intervals of s in each of C coarse cells.

    Attributes
    ----------
    start, length : ndarray, shape (C, MOST_ARCS)
        Intervals, rad or m; a length of -1 for none.
    covered : ndarray, shape (C,)
        Their union, rad or m.
    period : float
        2 pi, or infinite where joint 1 slides.
    """

    start: Floats
    length: Floats
    covered: Floats
    period: float

    def holds(self, cells: Indices, s: Floats) -> Bools:
        """Return whether s is covered in coarse cells; any common shape."""
        return np.asarray((self._after(cells, s) <= self.length[cells]).any(axis=-1))

    def _after(self, cells: Indices, s: Floats) -> Floats:
        after = np.asarray(s)[..., None] - self.start[cells]
        if math.isfinite(self.period):
            after = np.mod(after, self.period)
        return np.where(after >= 0.0, after, np.inf)


def all_zero(cells: int, joint: FirstJoint) -> Arcs:
    """Return arcs of ``cells`` cells with zeros everywhere, in memory that is not filled until it is used."""
    period = math.tau if joint.revolute else math.inf
    return Arcs(np.zeros((cells, MOST_ARCS)), np.zeros((cells, MOST_ARCS)), np.zeros(cells), period)


def arcs_of(least: Floats, most: Floats, joint: FirstJoint, closed: float = 0.0) -> Arcs:
    """Return the union of s + [low, high] over what was found.

    Parameters
    ----------
    least, most : ndarray, shape (C, k)
        Least and greatest s of successive intervals, by their start, rad or m; (inf, -inf) for missing ones.
    joint : FirstJoint
    closed : float
        Gaps between them up to so large count as found, rad or m.
    """
    found = np.asarray(most >= least)
    any_found = np.asarray(found.any(axis=1))
    if joint.full:
        whole = all_zero(len(least), joint)
        whole.length[:] = -1.0
        whole.length[any_found, 0] = whole.covered[any_found] = math.tau
        return whole
    stroke = joint.high - joint.low
    gaps = gaps_before(least, most, joint)
    gaps = np.where(gaps > closed, gaps - stroke, -np.inf)
    last = np.where(found, most, -np.inf).max(axis=1)
    return _between(gaps, np.where(found, least, 0.0), last, any_found, joint)


def _between(gaps: Floats, ends: Floats, last: Floats, any_found: Bools, joint: FirstJoint) -> Arcs:
    """Return the intervals between the widest gaps; with a prismatic joint 1 the outside is a gap as well."""
    row, order = np.arange(len(gaps))[:, None], np.argsort(-gaps, axis=1)
    others, order = order[:, MOST_ARCS:], order[:, :MOST_ARCS]
    width, begin = gaps[row, order], ends[row, order]
    real = width > 0.0
    # An interval begins after each gap and ends where the next gap begins.
    begin = np.where(real, begin, np.inf)
    by_place = np.argsort(begin, axis=1)
    begin, width, real = begin[row, by_place], width[row, by_place], real[row, by_place]
    finite = np.where(real, width, 0.0)
    following = np.roll(np.where(real, begin - finite, np.nan), -1, axis=1)
    count = real.sum(axis=1)
    stroke = joint.high - joint.low
    closing = begin[:, 0] - finite[:, 0] + math.tau if joint.revolute else last + stroke
    following[np.arange(len(gaps)), np.maximum(count - 1, 0)] = np.where(count > 0, closing, np.nan)
    length = np.where(real, following - np.where(real, begin, 0.0), -1.0)
    start = np.where(real, begin, 0.0) + joint.low
    whole = any_found & (count == 0)
    length[whole, 0] = math.tau
    covered = np.where(length > 0.0, length, 0.0).sum(axis=1)
    # Gaps too many to be kept are not covered all the same.
    covered -= np.maximum(gaps[row, others], 0.0).sum(axis=1)
    return Arcs(start, length, covered, math.tau if joint.revolute else math.inf)
