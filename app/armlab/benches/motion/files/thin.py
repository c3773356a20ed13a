"""The choice of a few out of many samples, from which waypoints are made."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

APART = 1e-4
"""Distance of two samples, rad or length scales, below which they are the same configuration."""


def evenly(t: Floats, q: Floats, count: int) -> list[int]:
    """Return the indices of samples at evenly spaced times; of equal ones in a row only the first is kept.

    Parameters
    ----------
    t : ndarray, shape (N,)
        Rising.
    q : ndarray, shape (N, n)
        Scaled so that joints can be compared.
    count : int
        At least 2.
    """
    wanted = np.linspace(t[0], t[-1], count)
    after = np.clip(np.searchsorted(t, wanted), 1, len(t) - 1)
    nearest = np.where(wanted - t[after - 1] <= t[after] - wanted, after - 1, after)
    return _distinct(q, sorted(set(nearest.tolist())))


def farthest(t: Floats, q: Floats, count: int) -> list[int]:
    """Return the indices of both ends, and then step by step of the sample farthest from the polygon so far.

    Parameters as of `evenly`; the times do not matter.

    References
    ----------
    Ramer 1972, Douglas and Peucker 1973, by number of points instead of a tolerance.
    """
    chosen = [0, len(q) - 1]
    while len(chosen) < min(count, len(q)):
        away = _missed(q, chosen)
        worst = int(np.argmax(away))
        if away[worst] < APART:
            break
        chosen = sorted([*chosen, worst])
    return _distinct(q, chosen)


def _missed(q: Floats, chosen: list[int]) -> Floats:
    """Return the distance of each sample from its side of the polygon, (N,)."""
    knots = np.array(chosen)
    side = np.clip(np.searchsorted(knots, np.arange(len(q)), side="right") - 1, 0, len(knots) - 2)
    start, way = q[knots[side]], q[knots[side + 1]] - q[knots[side]]
    length = np.einsum("ij,ij->i", way, way)
    along = np.einsum("ij,ij->i", q - start, way) / np.where(length > 0.0, length, 1.0)
    foot = start + np.clip(along, 0.0, 1.0)[:, None] * way
    return np.asarray(np.linalg.norm(q - foot, axis=1))


def _distinct(q: Floats, chosen: list[int]) -> list[int]:
    """Return indices without those whose configuration equals the previous one."""
    kept = chosen[:1]
    for k in chosen[1:]:
        if np.abs(q[k] - q[kept[-1]]).max() >= APART:
            kept.append(k)
    return kept
