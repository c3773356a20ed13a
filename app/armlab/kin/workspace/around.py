"""How much of s, the number that joint 1 changes, is covered at each place of a section.

A place (u, v) is reached at some values of s with q_1 = 0 (left and right shoulder give two; a redundant arm gives
intervals). Joint 1 carries each to all of s + [low, high]. What is covered is the union.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

BINS = 72
"""Of s: what is found within one (5 degrees) counts as all that lies between."""

FIRST_ROWS = 4096
"""Coarse cells for which there is room at first; it is doubled as it is needed."""

MOST_ARCS = 4
"""Separate intervals of s at one place that are kept; with more the smallest gaps are taken for covered."""


class Around:
    """Collects the values of s at q_1 = 0 with a configuration for each.

    Only coarse cells that were met have room: of a sliver they are few among many.

    Attributes
    ----------
    row : ndarray, shape (C,)
        Where in the following the coarse cells are; -1 for one that was not met.
    least, most : ndarray, shape (rows, BINS)
        Of the s met in a bin, rad or m; (inf, -inf) in one without.
    q : ndarray, shape (rows, BINS, n)
        A configuration of each, rad and m.
    """

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        self.width = grid.coarser
        self.joint: FirstJoint = grid.joint
        joint = grid.joint
        self.shape = tuple(-(-n // self.width) for n in grid.shape)
        reach = 2.0 * (joint.arm.reach or 1.0) + float(np.abs(joint.origin).sum())
        self.span = (-math.pi, math.pi) if joint.revolute else (-reach, reach)
        self.row = np.full(self.shape[0] * self.shape[1], -1)
        self.met = 0
        self.least = np.full((FIRST_ROWS, BINS), np.inf)
        self.most = np.full((FIRST_ROWS, BINS), -np.inf)
        self.q = np.zeros((FIRST_ROWS, BINS, joint.arm.n), dtype=np.float32)

    def coarse(self, cells: Indices) -> Indices:
        """Return the coarse cells in which cells of the section lie."""
        columns = self.grid.shape[1]
        return np.asarray((cells // columns) // self.width * self.shape[1] + (cells % columns) // self.width)

    def add(self, cells: Indices, s: Floats, q: NDArray[np.floating]) -> None:
        """Count values of s (k,) of configurations (k, n) with q_1 = 0 in cells of the section (k,)."""
        low, high = self.span
        bins = np.clip(((s - low) * (BINS / (high - low))).astype(np.intp), 0, BINS - 1)
        coarse = self.coarse(cells)
        self._make_room(np.unique(coarse[self.row[coarse] < 0]))
        flat = self.row[coarse] * BINS + bins
        np.minimum.at(self.least.reshape(-1), flat, s)
        np.maximum.at(self.most.reshape(-1), flat, s)
        self.q.reshape(-1, q.shape[1])[flat] = q

    def arcs(self) -> Arcs:
        """Return what joint 1 makes of it."""
        least, most = (np.full((len(self.row), BINS), sign * np.inf) for sign in (1.0, -1.0))
        met = np.flatnonzero(self.row >= 0)
        least[met], most[met] = self.least[self.row[met]], self.most[self.row[met]]
        return arcs_of(least, most, self.joint)

    def _make_room(self, fresh: Indices) -> None:
        """Give rows to coarse cells that were not met before."""
        self.row[fresh] = self.met + np.arange(len(fresh))
        self.met += len(fresh)
        more = max(self.met, 2 * len(self.least)) - len(self.least)
        if self.met > len(self.least):
            self.least = np.concatenate([self.least, np.full((more, BINS), np.inf)])
            self.most = np.concatenate([self.most, np.full((more, BINS), -np.inf)])
            self.q = np.concatenate([self.q, np.zeros((more, *self.q.shape[1:]), dtype=np.float32)])


@dataclass(frozen=True, eq=False)
class Arcs:
    """Which s are covered in each of C coarse cells.

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


def arcs_of(least: Floats, most: Floats, joint: FirstJoint) -> Arcs:
    """Return the union of s + [low, high] over what was found.

    Parameters
    ----------
    least, most : ndarray, shape (C, k)
        Of s in intervals in turn, by where they begin, rad or m; (inf, -inf) in one without.
    joint : FirstJoint
    """
    stroke = joint.high - joint.low
    cells = len(least)
    found = np.asarray(most >= least)
    any_found = np.asarray(found.any(axis=1))
    period = math.tau if joint.revolute else math.inf
    if joint.full:
        start = np.zeros((cells, MOST_ARCS))
        length = np.full((cells, MOST_ARCS), -1.0)
        length[any_found, 0] = math.tau
        return Arcs(start, length, np.where(any_found, math.tau, 0.0), period)
    first = np.where(found, least, np.inf).min(axis=1)
    gaps = np.full(least.shape, -np.inf)
    ends = np.zeros(least.shape)
    last = np.full(cells, np.nan)
    for b in range(least.shape[1]):
        rows = np.flatnonzero(found[:, b])
        old = rows[~np.isnan(last[rows])]
        gaps[old, b] = least[old, b] - last[old] - stroke
        ends[old, b] = least[old, b]
        last[rows] = np.fmax(last[rows], most[rows, b])
    wrap = first + math.tau - last - stroke if joint.revolute else np.full(cells, np.inf)
    return _between(gaps, ends, np.where(any_found, wrap, -np.inf), first, last, any_found, joint)


def _between(
    gaps: Floats,
    ends: Floats,
    wrap: Floats,
    first: Floats,
    last: Floats,
    any_found: Bools,
    joint: FirstJoint,
) -> Arcs:
    """Return the intervals between the widest gaps; where joint 1 slides, what is outside is a gap as well."""
    cells = len(first)
    all_gaps = np.concatenate([gaps, wrap[:, None]], axis=1)
    all_ends = np.concatenate([ends, first[:, None]], axis=1)
    order = np.argsort(-all_gaps, axis=1)[:, :MOST_ARCS]
    row = np.arange(cells)[:, None]
    width, begin = all_gaps[row, order], all_ends[row, order]
    real = (width > 0.0) & any_found[:, None]
    stroke = joint.high - joint.low
    # An interval begins after each gap and ends where the next gap begins.
    begin = np.where(real, begin, np.inf)
    by_place = np.argsort(begin, axis=1)
    begin, width, real = begin[row, by_place], width[row, by_place], real[row, by_place]
    following = np.roll(np.where(real, begin - width, np.nan), -1, axis=1)
    count = real.sum(axis=1)
    at_last = np.maximum(count - 1, 0)
    closing = begin[:, 0] - width[:, 0] + math.tau if joint.revolute else last + stroke
    following[np.arange(cells), at_last] = np.where(count > 0, closing, np.nan)
    length = np.where(real, following - begin, -1.0)
    start = np.where(real, begin, 0.0) + joint.low
    whole = any_found & (count == 0)
    length[whole, 0] = math.tau
    covered = np.where(length > 0.0, length, 0.0).sum(axis=1)
    return Arcs(start, length, covered, math.tau if joint.revolute else math.inf)
