"""Values of s met at q_1 = 0, in cells of a section or at places of it: bins with one configuration each."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.rows import ROOM, Rows

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

BINS = 72
"""Number of bins of s: two values within one bin (5 degrees) count as covering everything between."""


class Met:
    """Rows of bins over s, as many as are written.

    Attributes
    ----------
    span : (float, float)
        Range of s, rad or m, over which the bins lie; values beyond it are counted in the outer ones.
    least, most : Rows of shape (bins,)
        Least and greatest s met in a bin, rad or m; (inf, -inf) for an empty one.
    q : Rows of shape (bins, n)
        A configuration of each, rad and m, in single precision.
    ends : (float, float)
        Least and greatest of all s that were met, rad or m; (inf, -inf) before any.
    """

    def __init__(self, joint: FirstJoint, span: tuple[float, float], bins: int = BINS) -> None:
        self.joint, self.span, self.bins = joint, span, bins
        size = max(ROOM // bins, 1)
        self.least = Rows((bins,), size, np.inf)
        self.most = Rows((bins,), size, -np.inf)
        self.q = Rows((bins, joint.arm.n), size, dtype=np.float32)
        self.ends = (math.inf, -math.inf)

    def found(self, rows: Indices) -> Bools:
        """Return the bins of rows (k,) in which something was met, (k, bins)."""
        return np.asarray(self.most[rows] >= self.least[rows])

    def everything(self) -> NDArray[np.floating]:
        """Return the configurations of all bins of all rows, (k, n)."""
        blocks = zip(self.least.blocks, self.most.blocks, self.q.blocks, strict=True)
        return np.concatenate([q[most >= least] for least, most, q in blocks])

    def bin_of(self, s: Floats) -> Indices:
        """Return the bins in which values of s lie, any shape."""
        low, high = self.span
        return np.clip(((s - low) * (self.bins / (high - low))).astype(np.intp), 0, self.bins - 1)

    def put(self, rows: Indices, s: Floats, q: NDArray[np.floating]) -> None:
        """Count the values of s (k,) of configurations (k, n) with q_1 = 0 in rows (k,)."""
        if not len(s):
            return
        bins = self.bin_of(s)
        for least, within, here in self.least.parts(rows):
            np.minimum.at(least.reshape(-1), within * self.bins + bins[here], s[here])
        for most, within, here in self.most.parts(rows):
            np.maximum.at(most.reshape(-1), within * self.bins + bins[here], s[here])
        for known, within, here in self.q.parts(rows):
            known[within, bins[here]] = q[here]
        self.ends = (min(self.ends[0], float(s.min())), max(self.ends[1], float(s.max())))


def gaps_before(least: Floats, most: Floats, joint: FirstJoint) -> Floats:
    """Return how far each bin that was met lies behind the one met before it; -inf for one that was not.

    Where joint 1 turns, the first is behind the last, a turn earlier; where it slides, infinitely far behind nothing.

    Parameters
    ----------
    least, most : ndarray, shape (C, k)
        As in `Met`, or successive intervals by their start.
    joint : FirstJoint

    Returns
    -------
    ndarray, shape (C, k)
        Rad or m.
    """
    found = np.asarray(most >= least)
    position = np.arange(least.shape[1])
    furthest = np.maximum.accumulate(np.where(found, most, -np.inf), axis=1)
    before = np.concatenate([np.full((len(least), 1), -np.inf), furthest[:, :-1]], axis=1)
    first = found & (position == np.argmax(found, axis=1)[:, None])
    around = furthest[:, -1:] - math.tau if joint.revolute else np.full((len(least), 1), -np.inf)
    # Where nothing was met there is nothing behind which something could lie.
    behind = np.where(found, np.where(first, around, before), 0.0)
    return np.where(found, least - behind, -np.inf)


def last_found(found: Bools) -> Indices:
    """Return for each bin the last one up to it in which something was met, or -1, (C, k)."""
    return np.asarray(np.maximum.accumulate(np.where(found, np.arange(found.shape[1]), -1), axis=1))
