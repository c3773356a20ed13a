"""Values of s that were met at q_1 = 0, in cells of a section or at places of it: bins with a configuration each."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

BINS = 72
"""Of s: what is found within one (5 degrees) counts as all that lies between."""


class Met:
    """Rows of bins over s.

    Attributes
    ----------
    span : (float, float)
        Of s, rad or m, over which the bins lie; what is beyond counts to the last ones.
    least, most : ndarray, shape (rows, bins)
        Of the s met in a bin, rad or m; (inf, -inf) in one without.
    q : ndarray, shape (rows, bins, n)
        A configuration of each, rad and m.
    """

    def __init__(self, joint: FirstJoint, span: tuple[float, float], rows: int, bins: int = BINS) -> None:
        self.joint, self.span, self.bins = joint, span, bins
        self.least = np.full((rows, bins), np.inf)
        self.most = np.full((rows, bins), -np.inf)
        self.q = np.zeros((rows, bins, joint.arm.n), dtype=np.float32)

    @property
    def found(self) -> Bools:
        """Bins in which something was met, (rows, bins)."""
        return np.asarray(self.most >= self.least)

    def bin_of(self, s: Floats) -> Indices:
        """Return the bins in which values of s lie, any shape."""
        low, high = self.span
        return np.clip(((s - low) * (self.bins / (high - low))).astype(np.intp), 0, self.bins - 1)

    def put(self, rows: Indices, s: Floats, q: NDArray[np.floating]) -> None:
        """Count values of s (k,) of configurations (k, n) with q_1 = 0 to rows (k,)."""
        flat = rows * self.bins + self.bin_of(s)
        np.minimum.at(self.least.reshape(-1), flat, s)
        np.maximum.at(self.most.reshape(-1), flat, s)
        self.q.reshape(-1, q.shape[1])[flat] = q

    def make_room(self, rows: int) -> None:
        """Have at least so many rows; twice as many as before where they are too few."""
        more = max(rows, 2 * len(self.least)) - len(self.least)
        if rows > len(self.least):
            self.least = np.concatenate([self.least, np.full((more, self.bins), np.inf)])
            self.most = np.concatenate([self.most, np.full((more, self.bins), -np.inf)])
            self.q = np.concatenate([self.q, np.zeros((more, *self.q.shape[1:]), dtype=np.float32)])


def gaps_before(least: Floats, most: Floats, joint: FirstJoint) -> Floats:
    """Return how far each bin that was met lies behind the one met before it; -inf for one that was not.

    Where joint 1 turns, the first is behind the last, a turn earlier; where it slides, infinitely far behind nothing.

    Parameters
    ----------
    least, most : ndarray, shape (C, k)
        As of `Met`, or of intervals in turn by where they begin.
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
    """Return the last bin up to each, itself counted, in which something was met; -1 where there is none, (C, k)."""
    return np.asarray(np.maximum.accumulate(np.where(found, np.arange(found.shape[1]), -1), axis=1))
