"""Configurations that nearly reach a pose, where two branches would merge just beyond it.

Two real roots that merge and become complex leave their common real part behind, which misses the pose by about the
square of their imaginary parts: a stretched arm and a pose a little farther away.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.general_complex import REAL, Roots
from armlab.kin.ik.general_loop import Floats
from armlab.kin.ik.general_merge import wrapped
from armlab.kin.ik.general_polish import nearest

BESIDE = 0.03
"""Imaginary part, in radians, of roots that are examined: they miss the pose by up to about a thousandth."""

WEAK = (0.03, 1e-3)
"""Singular values, relative to the largest, below which the arm hardly moves its tool; the better of both results
counts."""

APART = 1e-2
"""Distance, in radians, from a solution below which a configuration is not listed beside it."""


def nearly(links: Floats, roots: Roots, known: Floats, solutions: Floats, hand: Floats) -> Floats:
    """Return the configurations (k, 6) nearest to a pose besides solutions, from nearly real roots and ``known``."""
    outside = np.abs(roots.q.imag).max(axis=1, initial=0.0)
    rows = (outside < BESIDE) & (outside >= REAL) & (roots.q.imag.sum(axis=1) >= 0.0)
    kept = list(solutions)
    starts = np.concatenate([roots.q[rows].real, known])
    hands = np.broadcast_to(hand, (len(starts), 4, 4))
    one, other = (nearest(links, starts, hands, weak) for weak in WEAK)
    for best in np.where((other.sizes < one.sizes)[:, None], other.q, one.q):
        if not kept or np.abs(wrapped(best - np.array(kept))).max(axis=1).min() > APART:
            kept.append(best)
    return np.array(kept[len(solutions) :]).reshape(-1, 6)
