"""Jumps of derivatives, and the order up to which a function is continuous there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

ORDERS = (0, 1, 2, 3)
"""Orders, 0 to 3, of the value and the derivatives that paths, laws and motions have."""

SMOOTH = 3.0
"""Class of a place where none of these derivatives jumps: C3 or smoother."""

SMOOTH_ENOUGH = 2
"""Class, from rest and to rest, for which the jerk is finite everywhere."""

JUMP = 1e-8
"""Jump, relative to the largest value of the derivative, below which it is rounding."""

NOISE = 1e-10
"""Relative rounding of a lower derivative, which appears in a higher one divided by the length of a piece."""


def classes(before: Sequence[Floats], after: Sequence[Floats], lengths: Floats) -> Floats:
    """Return the class of continuity at each of k places: 0 for C0, 1, 2, `SMOOTH`; -1 where values jump.

    Parameters
    ----------
    before, after : sequences of ndarray, shape (k, m)
        Limits of the derivatives of orders 0, 1, 2, 3 from the left and from the right.
    lengths : ndarray, shape (k,)
        Length of the shorter neighbouring piece.
    """
    found = np.full(len(lengths), SMOOTH)
    for order, jumping in reversed(list(enumerate(jumps(before, after, lengths)))):
        found = np.where(jumping.any(axis=1), float(order - 1), found)
    return found


def jumps(before: Sequence[Floats], after: Sequence[Floats], lengths: Floats) -> list[NDArray[np.bool_]]:
    """Return for each order which components jump at which places, (k, m) each; arguments as in `classes`."""
    sizes = [max(_largest(a), _largest(b)) for a, b in zip(before, after, strict=True)]
    found = []
    for order, (left, right) in enumerate(zip(before, after, strict=True)):
        floor = np.full(len(lengths), JUMP * sizes[order])
        for lower in range(order):
            floor = np.maximum(floor, NOISE * sizes[lower] / lengths ** (order - lower))
        found.append(np.abs(right - left) > floor[:, None])
    return found


def class_text(continuity: float) -> str:
    """Return a class in words.

    Examples
    --------
    >>> class_text(2), class_text(SMOOTH)
    ('C2', 'C3 or smoother')
    """
    if continuity < 0:
        return "not continuous"
    return "C3 or smoother" if continuity >= SMOOTH else f"C{continuity:.0f}"


def _largest(values: Floats) -> float:
    return float(np.abs(values).max(initial=0.0))


def merged(places: Sequence[Floats], low: float, high: float) -> Floats:
    """Return the sorted places inside (low, high); those closer than rounding are one."""
    every = np.sort(np.concatenate([np.zeros(0), *places]))
    apart = 1e-12 * (high - low)
    every = every[(every > low + apart) & (every < high - apart)]
    if len(every) == 0:
        return every
    return np.asarray(every[np.concatenate([[True], np.diff(every) > apart])])


def snapped(places: Floats, edges: Floats, apart: float) -> Floats:
    """Return places (k,), those nearer than ``apart`` to one of the sorted edges moved there.

    Rounding must not decide on which side of the end of a piece a place is.
    """
    after = np.clip(np.searchsorted(edges, places), 1, len(edges) - 1)
    before = after - 1
    nearest = np.where(places - edges[before] < edges[after] - places, edges[before], edges[after])
    return np.where(np.abs(nearest - places) < apart, nearest, places)


def stopped(values: Sequence[Floats], before: bool) -> list[Floats]:
    """Return derivatives (k, m) at the edges of a motion, with rest before the first and after the last edge."""
    found = [np.array(each) for each in values]
    for each in found[1:]:
        each[0 if before else -1] = 0.0
    return found
