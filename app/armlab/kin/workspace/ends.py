"""Where s ends at one place of each coarse cell, found by inverse kinematics with u and v held.

Samples tell about which s are met somewhere in a cell. What is covered is wanted at a place: the outermost of each run
of neighbouring s are pulled to the place, and along s as far as it goes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.around import BINS, MOST_ARCS, Arcs, Around, arcs_of
from armlab.kin.workspace.filling import Filling
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.pull import least_squares, pull, section_rates

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

PULLED = 1024
"""Configurations pulled in a piece of work."""

OUTERMOST = 2
"""Bins at each end of a run from which its end is looked for."""

NEAR, SCARCELY = 0.75, 1e-6
"""Of a cell: how near a place is to a centre that was reached; and the weight of a centre that was not."""

THERE = 1e-3
"""Of a cell: as near to a place as that is there."""

AHEAD = 1.0
"""Radians, or length scales, that an end is pulled onward."""

LIGHT = 0.05
"""Weight of s beside u and v in a pull along s."""

ALONG, HOME = 16, 10
"""Iterations of a pull along s, and of one to the place."""

APART = 0.2
"""Radians or metres from a run that make another."""

SWEEPS = 1
"""Times that the ends of neighbouring places are tried."""


class Ends:
    """Runs of s at one place of each coarse cell.

    Attributes
    ----------
    cells : ndarray, shape (C,)
        Coarse cells with a place.
    places : ndarray, shape (C, 2)
        (u, v), metres.
    least, most : ndarray, shape (C, RUNS)
        Of the s of a run, rad or m, in turn from `begin`; (inf, -inf) where there is none.
    """

    def __init__(self, filling: Filling) -> None:
        assert filling.around is not None
        self.filling, self.around = filling, filling.around
        self.joint: FirstJoint = filling.joint
        self.single = len(self.joint.moving) <= (1 if filling.grid.flat else 2)
        self.cells, self.fine, self.places = _representatives(filling, filling.around)
        self._stay(~filling.centred[self.fine])
        self.starts, self.owner, self.run, self.onward, self.begin, self.count = _runs(self.around, self.cells)
        C = len(self.cells)
        self.least = np.full((C, MOST_ARCS), np.inf)
        self.most = np.full((C, MOST_ARCS), -np.inf)
        self.q = np.zeros((2, C, MOST_ARCS, self.joint.arm.n))

    def find(self) -> Iterator[None]:
        """Find the ends, a piece at a time."""
        yield from self._try(self.starts, self.owner, self.run, self.onward)
        missed = (self.count > 0) & ~np.isfinite(self.least).any(axis=1)
        self._stay(missed)
        of = np.flatnonzero(missed)
        self._count(self.filling.q[self.fine[of]], of, np.zeros_like(of), np.full(len(of), np.nan))
        for _ in range(SWEEPS):
            for some in self._neighbours():
                yield from self._try(*some)

    def arcs(self) -> Arcs:
        """Return what joint 1 makes of the runs, for all coarse cells."""
        order = np.argsort(self.least, axis=1)
        least, most = (np.take_along_axis(each, order, axis=1) for each in (self.least, self.most))
        arcs = arcs_of(least, most, self.joint)
        shape = self.around.shape[0] * self.around.shape[1]
        start, length = np.zeros((shape, MOST_ARCS)), np.full((shape, MOST_ARCS), -1.0)
        covered = np.zeros(shape)
        start[self.cells] = arcs.start + self.begin[:, None] * (arcs.length > 0.0)
        length[self.cells], covered[self.cells] = arcs.length, arcs.covered
        whole = self.cells[self.count == 0]
        start[whole], length[whole] = 0.0, -1.0
        length[whole, 0] = covered[whole] = math.tau
        return Arcs(start, length, covered, arcs.period)

    def _try(self, starts: Floats, owner: Indices, run: Indices, onward: Floats) -> Iterator[None]:
        """Pull configurations to the places of their owners and along s; count what comes of them to runs."""
        tolerance = THERE * self.filling.grid.step
        for first in range(0, len(starts), PULLED):
            some = slice(first, first + PULLED)
            of = owner[some]
            q, error = pull(self.joint, starts[some], self.places[of], tolerance, iterations=HOME)
            good = np.flatnonzero(error <= tolerance)
            q, of, sign, which = q[good], of[good], onward[some][good], run[some][good]
            self._count(q, of, which, np.full(len(q), np.nan))
            s = self._s(q)
            yield
            if self.single:
                continue
            far = along(self.joint, q, self.places[of], s + sign * AHEAD)
            far, error = pull(self.joint, far, self.places[of], tolerance, iterations=HOME)
            good = np.flatnonzero(error <= tolerance)
            self._count(far[good], of[good], which[good], s[good])
            yield

    def _stay(self, which: Bools) -> None:
        """Let the places of some cells be where the configuration is that fills them."""
        q = self.filling.q[self.fine[which]]
        self.places[which] = self.joint.split(self.joint.arm.position(q))[:, :2]

    def _s(self, q: Floats) -> Floats:
        return np.asarray(self.joint.split(self.joint.arm.position(q))[:, 2])

    def _count(self, q: Floats, of: Indices, run: Indices, near: Floats) -> None:
        """Count configurations at places to runs; ``near`` is an s less than half a turn away, nan for any."""
        s = self._s(q) - self.begin[of]
        if self.joint.revolute:
            s = np.mod(s, math.tau)
            before = np.mod(near - self.begin[of], math.tau)
            s = np.where(np.isnan(near), s, before + np.remainder(s - before + math.pi, math.tau) - math.pi)
        for side, (values, reduced) in enumerate(((self.least, np.minimum), (self.most, np.maximum))):
            flat = of * MOST_ARCS + run
            reduced.at(values.reshape(-1), flat, s)
            best = values.reshape(-1)[flat] == s
            self.q[side].reshape(-1, self.q.shape[-1])[flat[best]] = q[best]

    def _neighbours(self) -> Iterator[tuple[Floats, Indices, Indices, Floats]]:
        """Yield the ends of neighbouring places as starts, with whom they are tried for, each place once at a time."""
        rows, columns = self.around.shape
        at = np.full((rows + 2, columns + 2), -1)
        i, j = np.divmod(self.cells, columns)
        at[i + 1, j + 1] = np.where(self.count > 0, np.arange(len(self.cells)), -1)
        for di, dj in ((0, 1), (2, 1), (1, 0), (1, 2)):
            other = at[i + di, j + dj]
            mine = np.flatnonzero((other >= 0) & (self.count > 0))
            for run in range(MOST_ARCS):
                for side, sign in ((0, -1.0), (1, 1.0)):
                    there = mine[self.most[other[mine], run] > -np.inf]
                    q = self.q[side, other[there], run]
                    into = self._run_of(q, there)
                    yield q, there, into, np.full(len(q), sign)

    def _run_of(self, q: Floats, of: Indices) -> Indices:
        """Return the runs of places nearest to the s of configurations, or a new one."""
        s = self._s(q) - self.begin[of]
        if self.joint.revolute:
            s = np.mod(s, math.tau)
        low, high = self.least[of], self.most[of]
        away = np.where(high >= low, np.maximum(np.maximum(low - s[:, None], s[:, None] - high), 0.0), np.inf)
        nearest, empty = np.argmin(away, axis=1), np.argmax(high < low, axis=1)
        # What is far from all runs is another one, as long as there is room.
        far = (away.min(axis=1) > APART) & (high < low).any(axis=1)
        return np.asarray(np.where(far, empty, nearest))


def along(joint: FirstJoint, q: Floats, places: Floats, wanted: Floats) -> Floats:
    """Return configurations (k, n) pulled towards s (k,) about where (u, v) stay as they are, (k, 2)."""
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
        return np.concatenate([section_rates(joint, values), weight[rows, None, None] * turn[:, None, :]], axis=1)

    return least_squares(joint, q, residual, rates, joint.moving, 0.0, ALONG)[0]


def _representatives(filling: Filling, around: Around) -> tuple[Indices, Indices, Floats]:
    """Return the coarse cells with a filled cell, one filled cell of each, and the place that stands for them, (C, 2).

    The middle of the cells whose centre was reached, so that what is covered is neither too much nor too little where
    it rises or falls; the filled cell is the nearest to it.
    """
    fine = np.flatnonzero(filling.filled)
    cells, of = np.unique(around.coarse(fine), return_inverse=True)
    centres, centred = filling.grid.centres(fine), filling.centred[fine]
    weight = np.where(centred, 1.0, SCARCELY)
    total = np.bincount(of, weight)
    middle = np.stack([np.bincount(of, weight * centres[:, k]) / total for k in range(2)], axis=1)
    away = np.linalg.norm(centres - middle[of], axis=1) / filling.grid.step
    order = np.lexsort((away + np.where(centred, 0.0, 10.0 * around.width), of))
    first = order[np.unique(of[order], return_index=True)[1]]
    near = (away[first] <= NEAR) & centred[first]
    return cells, fine[first], np.where(near[:, None], middle, centres[first])


def _runs(around: Around, cells: Indices) -> tuple[Floats, Indices, Indices, Floats, Floats, Indices]:
    """Return from where to look for ends.

    Runs are what lies between gaps that joint 1 might not close, the widest ones where there are many.

    Returns
    -------
    starts : ndarray, shape (k, n)
    owner, run : ndarray, shape (k,)
        Index into the cells, and which run.
    onward : ndarray, shape (k,)
        1 to look for the largest s, -1 for the least.
    begin : ndarray, shape (C,)
        s from which runs are counted: in the widest gap, where s goes round.
    count : ndarray, shape (C,)
        Runs; 0 where everything is covered.
    """
    rows_of, joint = around.row[cells], around.joint
    least, most = around.least[rows_of], around.most[rows_of]
    C = len(cells)
    found = most >= least
    stroke = joint.high - joint.low
    low, high = around.span
    bin_width = (high - low) / BINS
    # In turn from the first bin that was met, and once round.
    position = np.arange(BINS)
    previous = np.maximum.accumulate(np.where(found, position, -1), axis=1)
    before = np.concatenate([np.full((C, 1), -1), previous[:, :-1]], axis=1)
    last = np.where(before >= 0, np.take_along_axis(most, np.maximum(before, 0), axis=1), np.nan)
    final = np.take_along_axis(most, np.maximum(previous[:, -1:], 0), axis=1)
    if joint.revolute:
        last = np.where(np.isnan(last), final - math.tau, last)
    gap = np.where(found, least - last, -np.inf)
    gap = np.where(np.isnan(gap), np.inf, gap)
    cut = found & (gap > stroke - 2.0 * bin_width) & (gap > 0.0)
    # Only so many runs are kept.
    ranked = np.sort(np.where(cut, gap, -np.inf), axis=1)[:, -MOST_ARCS]
    cut &= gap >= ranked[:, None]
    count = cut.sum(axis=1)
    widest = np.argmax(np.where(cut, gap, -np.inf), axis=1)
    rows = np.arange(C)
    begin = np.where(count > 0, least[rows, widest], 0.0)
    begin = begin - np.where(np.isfinite(gap[rows, widest]), 0.5 * np.maximum(gap[rows, widest], 0.0), 1.0) * (
        count > 0
    )
    # Bins in turn from the one after the widest gap.
    order = (widest[:, None] + position) % BINS
    cut_o, found_o = np.take_along_axis(cut, order, 1), np.take_along_axis(found, order, 1)
    run = np.minimum(np.cumsum(cut_o, axis=1) - 1, MOST_ARCS - 1)
    from_start = _rank(found_o, run)
    from_end = _rank(found_o[:, ::-1], run[:, ::-1])[:, ::-1]
    starts, owner, of, onward = [], [], [], []
    for rank, sign in ((from_start, -1.0), (from_end, 1.0)):
        c, b = np.nonzero(found_o & (rank <= OUTERMOST) & (count > 0)[:, None])
        starts.append(around.q[rows_of[c], order[c, b]].astype(np.float64))
        owner.append(c)
        of.append(run[c, b])
        onward.append(np.full(len(c), sign))
    limits = joint.arm.limits
    q = np.concatenate(starts)
    q[:, 1:] = np.clip(q[:, 1:], limits[1:, 0], limits[1:, 1])
    return q, np.concatenate(owner), np.concatenate(of), np.concatenate(onward), begin, count


def _rank(found: Bools, run: Indices) -> Indices:
    """Return how many of a run were found up to each bin, itself counted."""
    total = np.cumsum(found, axis=1)
    base = np.zeros_like(total)
    for k in range(MOST_ARCS):
        here = run == k
        first = np.argmax(here, axis=1)
        start: Indices = np.take_along_axis(total, first[:, None], 1) - np.take_along_axis(found, first[:, None], 1)
        base = np.where(here, start, base)
    return np.asarray(total - base)
