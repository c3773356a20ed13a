"""Ranges of s at one place of each coarse cell, found by inverse kinematics with u, v held.

Samples tell about which s are met somewhere in a cell, and together they always make of it too much: where a branch
ends inside a cell, it would count for all of it. So what is met is pulled to one place, and only what arrives counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.around import Arcs, Around, all_zero, arcs_of
from armlab.kin.workspace.filling import Filling
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.met import BINS, Met, gaps_before, last_found
from armlab.kin.workspace.pull import least_squares, pieces, pull, section_rates

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

PULLED = 512
"""Configurations pulled in one piece of work."""

HOPPING = 256
"""Configurations pulled along s in one piece of work: fewer, as this takes more iterations."""

TOGETHER = 1024
"""Places that are examined together."""

EMPTIED = 1 << 17
"""Coarse cells that are marked as not reached in one piece of work."""

MOST_BINS = 4 * BINS
"""Largest number of bins of s at a place, where a short stroke of joint 1 needs more than `BINS`."""

THERE = 1e-3
"""Distance from a place, in cells, at which it is reached."""

AHEAD = 1.0
"""Distance, in radians or length scales, by which an end is pulled onward."""

HOP = 0.8
"""Distance of two values of s, relative to the stroke of joint 1, within which all between is certainly covered."""

ONWARD = 0.1
"""Fraction of the wanted motion below which an end stays: it is an end of the range."""

HOPS = 8
"""Largest number of times that an end is pulled onward."""

LIGHT = 0.05
"""Weight of s beside u and v when pulling along s."""

ALONG, HOME = 16, 10
"""Iterations of a pull along s, and of one to the place."""

BESIDE = 1e-3
"""Depth inside a gap, radians or metres, from which values met beside a place are tried there."""


class Ends:
    """The s that are met at one place of each coarse cell.

    Attributes
    ----------
    cells : ndarray, shape (C,)
        Coarse cells with a place.
    places : ndarray, shape (C, 2)
        (u, v), metres.
    met : Met
        Values of s met at the places, one row for each.
    closed : float
        Gaps up to so large count as met, rad or m.
    """

    def __init__(self, filling: Filling, rng: np.random.Generator) -> None:
        assert filling.around is not None
        self.filling, self.around = filling, filling.around
        self.joint: FirstJoint = filling.joint
        self.single = filling.grid.single
        self.cells, self.fine, self.places = _representatives(filling, filling.around, rng)
        self.row = self.around.row[self.cells]
        span = self.around.span
        if not self.joint.revolute:
            span = self.around.ends[0], self.around.ends[1] + THERE
        stroke = self.joint.high - self.joint.low
        bins = int(np.clip((span[1] - span[0]) / max(stroke, 1e-9), BINS, MOST_BINS))
        self.met = Met(self.joint, span, bins)
        # Where (u, v) leave single values of s, nothing is met between two of them.
        self.closed = 0.0 if self.single else (span[1] - span[0]) / BINS
        self.gap = max(stroke, self.closed)
        self._arcs = all_zero(self.around.shape[0] * self.around.shape[1], self.joint)

    def find(self) -> Iterator[None]:
        """Find the values of s at all places, a piece of work at a time."""
        for first in range(0, len(self._arcs.length), EMPTIED):
            self._arcs.length[first : first + EMPTIED] = -1.0
            yield
        for rows in self._blocks():
            yield from self._look(rows)
        for rows in self._blocks():
            for shift in ((0, -1), (0, 1), (-1, 0), (1, 0)):
                yield from self._from_beside(rows, shift)
        for rows in self._blocks():
            self._sum_up(rows)
            yield

    def arcs(self) -> Arcs:
        """Return the intervals that joint 1 covers, for all coarse cells."""
        return self._arcs

    def _blocks(self) -> Iterator[Indices]:
        for first in range(0, len(self.cells), TOGETHER):
            yield np.arange(first, min(first + TOGETHER, len(self.cells)))

    def _look(self, rows: Indices) -> Iterator[None]:
        """Find values of s at some places from the configurations in their cells, and onward from there."""
        at_home = self.filling.at(self.fine[rows])
        yield from self._try(at_home, rows)
        missed = ~self.met.found(rows).any(axis=1)
        # The place stays where the configuration is that fills the cell.
        self.places[rows[missed]] = self.joint.split(self.joint.arm.position(at_home[missed]))[:, :2]
        self._count(at_home[missed], rows[missed])
        source = self.around.found(self.row[rows])
        first = _stones(self.around.least[self.row[rows]], self.around.most[self.row[rows]], self.joint, HOP * self.gap)
        yield
        yield from self._try_bins(rows, first)
        yield
        yield from self._try_bins(rows, source & ~first & self._in_gaps(rows))
        if not self.single:
            yield
            yield from self._onward(*self._ends(rows))

    def _try_bins(self, rows: Indices, which: Bools) -> Iterator[None]:
        """Pull configurations of a cell, in bins (len(rows), BINS), to its place."""
        i, b = np.nonzero(which)
        for some in pieces(self.joint, len(i), PULLED):
            starts = self.around.q.at(self.row[rows[i[some]]], b[some]).astype(np.float64)
            yield from self._try(starts, rows[i[some]])

    def _try(self, starts: Floats, of: Indices) -> Iterator[None]:
        """Pull configurations (k, n) to places, and count those that arrive."""
        limits = self.joint.arm.limits
        tolerance = THERE * self.filling.grid.step
        for some in pieces(self.joint, len(starts), PULLED):
            q = starts[some].copy()
            q[:, 1:] = np.clip(q[:, 1:], limits[1:, 0], limits[1:, 1])
            q, error = pull(self.joint, q, self.places[of[some]], tolerance, iterations=HOME)
            good = error <= tolerance
            self._count(q[good], of[some][good])
            yield

    def _count(self, q: Floats, of: Indices) -> None:
        self.met.put(of, self._s(q), q)

    def _s(self, q: Floats) -> Floats:
        return np.asarray(self.joint.split(self.joint.arm.position(q))[:, 2])

    def _gaps(self, rows: Indices) -> Floats:
        """Return the gaps not closed by joint 1 before each bin at some places; -inf for the other bins."""
        gaps = gaps_before(self.met.least[rows], self.met.most[rows], self.joint)
        return np.where(gaps > self.gap, gaps, -np.inf)

    def _in_gaps(self, rows: Indices) -> Bools:
        """Return which bins met in surrounding cells lie in gaps here that joint 1 does not close, (k, BINS)."""
        around = self.row[rows]
        s = np.where(self.around.found(around), self.around.least[around], 0.0)
        return self._in_gap(np.repeat(rows[:, None], s.shape[1], axis=1), s, 0.0)

    def _in_gap(self, rows: Indices, s: Floats, deep: float) -> Bools:
        """Return which s lie in a gap at places, at least ``deep`` from its ends; any common shape."""
        some, at = np.unique(rows, return_inverse=True)
        at = at.reshape(rows.shape)
        gaps = self._gaps(some)
        found = gaps_before(self.met.least[some], self.met.most[some], self.joint) > -np.inf
        bins = self.met.bins
        # The next bin that was met at or after each, once round.
        behind = last_found(found[:, ::-1])[:, ::-1]
        following = np.where(behind >= 0, bins - 1 - behind, bins - 1 - last_found(found[:, ::-1])[:, -1:])
        b = self.met.bin_of(s)
        after = following[at, b]
        width = gaps[at, after]
        ahead = self.met.least[some][at, after] - s
        if self.joint.revolute:
            ahead = np.mod(ahead, math.tau)
        inside = (width > 0.0) & (ahead > deep) & (ahead < width - deep)
        if not self.joint.revolute:
            # Behind all that was met there is no end of the gap.
            most = self.met.most[some].max(axis=1)[at]
            inside |= s > most + deep
        return np.asarray(inside)

    def _ends(self, rows: Indices) -> tuple[Floats, Indices, Floats]:
        """Return configurations at the ends of gaps at some places, the places' rows, and the ways into the gaps."""
        gaps = self._gaps(rows)
        i, b = np.nonzero(gaps > 0.0)
        last = last_found(self.met.found(rows))
        previous = np.where(b > 0, last[i, np.maximum(b - 1, 0)], -1)
        previous = np.where(previous >= 0, previous, last[i, -1])
        q = np.concatenate([self.met.q.at(rows[i], b), self.met.q.at(rows[i], previous)]).astype(np.float64)
        return q, np.tile(rows[i], 2), np.repeat([-1.0, 1.0], len(i))

    def _onward(self, q: Floats, of: Indices, sign: Floats) -> Iterator[None]:
        """Pull configurations at places onward into gaps as far as they go, in steps that joint 1 closes."""
        for some in pieces(self.joint, len(q), HOPPING):
            # Asked for much it goes farthest; by hops it meets what lies between.
            yield from self._hopping(q[some], of[some], sign[some], AHEAD)
            if HOP * self.gap < AHEAD:
                yield from self._hopping(q[some], of[some], sign[some], HOP * self.gap)

    def _hopping(self, q: Floats, of: Indices, sign: Floats, hop: float) -> Iterator[None]:
        tolerance = THERE * self.filling.grid.step
        for _ in range(HOPS):
            s = self._s(q)
            far = along(self.joint, q, self.places[of], s + sign * hop)
            yield
            far, error = pull(self.joint, far, self.places[of], tolerance, iterations=HOME)
            self._count(far[error <= tolerance], of[error <= tolerance])
            moved = self._s(far) - s
            if self.joint.revolute:
                moved = np.remainder(moved + math.pi, math.tau) - math.pi
            on = (error <= tolerance) & (sign * moved > ONWARD * hop)
            yield
            on[on] = self._in_gap(of[on], self._s(far[on]) + BESIDE * sign[on], 0.0)
            if not on.any():
                return
            q, of, sign = far[on], of[on], sign[on]

    def _from_beside(self, rows: Indices, shift: tuple[int, int]) -> Iterator[None]:
        """Try at some places the configurations met at neighbouring ones that lie in a gap here."""
        columns = self.around.shape[1]
        gaping = rows[(self._gaps(rows) > 0.0).any(axis=1)]
        i, j = self.cells[gaping] // columns + shift[0], self.cells[gaping] % columns + shift[1]
        on = (i >= 0) & (i < self.around.shape[0]) & (j >= 0) & (j < columns)
        gaping, beside = gaping[on], i[on] * columns + j[on]
        at = np.minimum(np.searchsorted(self.cells, beside), len(self.cells) - 1)
        there = self.cells[at] == beside
        gaping, at = gaping[there], at[there]
        k, b = np.nonzero(self.met.found(at))
        s = self.met.least.at(at[k], b)
        some = self._in_gap(gaping[k], s, BESIDE)
        mine, q = gaping[k[some]], self.met.q.at(at[k[some]], b[some]).astype(np.float64)
        yield
        yield from self._try(q, mine)
        if not self.single:
            q, whose, sign = self._ends(np.unique(mine))
            yield from self._onward(q, whose, sign)

    def _sum_up(self, rows: Indices) -> None:
        found = arcs_of(self.met.least[rows], self.met.most[rows], self.joint, self.closed)
        cells = self.cells[rows]
        self._arcs.start[cells], self._arcs.length[cells] = found.start, found.length
        self._arcs.covered[cells] = found.covered


def along(joint: FirstJoint, q: Floats, places: Floats, wanted: Floats) -> Floats:
    """Return configurations (k, n) pulled towards s (k,) with (u, v), (k, 2), nearly unchanged."""
    weight = LIGHT * joint.measure(np.maximum(places[:, 0], 0.05 * joint.arm.length_scale))

    def residual(values: Floats, rows: Indices) -> Floats:
        found = joint.split(joint.arm.position(values))
        off = wanted[rows] - found[:, 2]
        if joint.revolute:
            off = np.remainder(off + math.pi, math.tau) - math.pi
        return np.column_stack([places[rows] - found[:, :2], weight[rows] * off])

    def rates(values: Floats, rows: Indices) -> Floats:
        J = np.asarray(joint.arm.jacobian(values)[:, :3, :])
        found = joint.split(joint.arm.position(values))
        if joint.revolute:
            across = np.cos(found[:, 2])[:, None] * joint.axes[:, 1] - np.sin(found[:, 2])[:, None] * joint.axes[:, 0]
            turn = np.einsum("ka,kan->kn", across, J) / np.maximum(found[:, 0], 1e-9)[:, None]
        else:
            turn = np.einsum("a,kan->kn", joint.axes[:, 2], J)
        return np.concatenate([section_rates(joint, J), weight[rows, None, None] * turn[:, None, :]], axis=1)

    return least_squares(joint, q, residual, rates, joint.moving, 0.0, ALONG)[0]


def _representatives(filling: Filling, around: Around, rng: np.random.Generator) -> tuple[Indices, Indices, Floats]:
    """Return the coarse cells with a filled cell, one filled cell of each, and the place that stands for them, (C, 2).

    The middle of a coarse cell that is reached everywhere, which is best where what is covered rises or falls; else the
    centre of any of its cells that is reached: the middle of what is reached of it would lie too far from the boundary,
    where less is covered, more often than not.
    """
    fine = np.flatnonzero(filling.filled)
    cells, of = np.unique(around.coarse(fine), return_inverse=True)
    centres, centred = filling.grid.centres(fine), filling.centred[fine]
    count = np.bincount(of, centred)
    whole = count == (around.width if filling.grid.flat else around.width**2)
    middle = np.stack([np.bincount(of, centres[:, k]) / np.bincount(of) for k in range(2)], axis=1)
    away = np.linalg.norm(centres - middle[of], axis=1)
    order = np.lexsort((np.where(whole[of], away, rng.random(len(fine))), ~centred, of))
    first = order[np.unique(of[order], return_index=True)[1]]
    places = np.where(whole[:, None], middle, centres[first])
    q = filling.at(fine[first])
    off = count == 0
    places[off] = filling.joint.split(filling.joint.arm.position(q[off]))[:, :2]
    return cells, fine[first], places


def _stones(least: Floats, most: Floats, joint: FirstJoint, hop: float) -> Bools:
    """Return some bins that were met, (C, BINS): both ends of each run, and as few between them as steps allow."""
    found = np.asarray(most >= least)
    start = gaps_before(least, most, joint) > hop
    chosen = np.zeros(found.shape, dtype=bool)
    rows = np.arange(len(found))
    last, previous = np.full(len(found), -np.inf), np.full(len(found), -1)
    for b in range(found.shape[1]):
        here = found[:, b]
        first = here & (start[:, b] | (previous < 0))
        # The one before this one, where a run ends there or this one is too far from the last that was chosen.
        before = here & (previous >= 0) & (first | (most[:, b] > last + hop))
        chosen[rows[before], previous[before]] = True
        last[before] = most[rows[before], previous[before]]
        chosen[:, b] |= first
        last = np.where(first, least[:, b], last)
        previous = np.where(here, b, previous)
    known = previous >= 0
    chosen[rows[known], previous[known]] = True
    return chosen
