"""The fastest squared speed x = s'^2 along a path, on a grid, by a backward pass (braking) and a forward pass.

Between two places x is a straight line over s, so that s'' = (y - x) / (2 h) is constant there, with y the x at the end
and h the step. Every limit of a velocity or an acceleration is then a band of the plane: |A x + B y| <= 1. This is
linear programming in one unknown, in closed form, with a band for each joint and place.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

NOTHING = 1e-12
"""Coefficient, relative to the largest in a step, below which a band does not depend on that unknown."""


ROUNDING = 1e-13
"""Height above the top, relative, up to which two lines count as meeting there."""

HUGE = 1e60
"""Value larger than any squared speed."""

RUSH = 1e4
"""Factor of the median of the largest squared speeds: where the path stands still, s may become arbitrarily fast.
Beyond a hundred times its usual speed it would gain less than a hundredth of the time."""


class Bands(NamedTuple):
    """Limits of N steps, R bands each.

    Attributes
    ----------
    A, B : ndarray, shape (N, R)
        A band is |A x + B y| <= 1, of the squared speeds x at the beginning and y at the end of the step.
    """

    A: Floats
    B: Floats


class Controllable(NamedTuple):
    """The squared speeds from which the end can be reached within the limits, shape (N+1,)."""

    least: Floats
    most: Floats


def solved_for(one: Floats, other: Floats) -> tuple[Floats, Floats]:
    """Return e and f (N, R) with -e + f v <= u <= e + f v for bands |one u + other v| <= 1; e is infinite without u."""
    size = np.maximum(np.abs(one), np.abs(other)).max(axis=1, keepdims=True, initial=0.0)
    known = np.abs(one) > NOTHING * size
    safe = np.where(known, one, 1.0)
    return np.where(known, 1.0 / np.abs(safe), np.inf), np.where(known, -other / safe, 0.0)


def tops(bands: Bands) -> tuple[Floats, Floats]:
    """Return the largest x of each step and the y it goes with, (N,): infinite where no band holds it.

    Over y >= 0 the largest x is the least of the lines e + f y, a concave function. Two of them on either side of its
    top meet above it; where they do another line is below, and takes the place of one of the two.
    """
    e, f = solved_for(bands.A, bands.B)
    N, rows = e.shape
    every = np.arange(N)
    left, right = e.argmin(axis=1), np.where(np.isinf(e), np.inf, f).argmin(axis=1)
    y, top = np.zeros(N), e[every, left]
    rising = f[every, left] > 0.0
    open_ = rising & (f[every, right] <= 0.0)
    unbounded = rising & ~open_
    for _ in range(2 * rows):
        at = np.flatnonzero(open_)
        if not len(at):
            break
        low, high = left[at], right[at]
        y[at] = (e[at, high] - e[at, low]) / (f[at, low] - f[at, high])
        meet = e[at, low] + f[at, low] * y[at]
        lines = e[at] + f[at] * y[at, None]
        least = lines.argmin(axis=1)
        top[at] = lines[np.arange(len(at)), least]
        slope = f[at, least]
        open_[at] = (top[at] < meet - ROUNDING * np.abs(meet)) & (slope != 0.0)
        left[at], right[at] = np.where(slope > 0.0, least, low), np.where(slope > 0.0, high, least)
    # Where no line falls it is the lower sides that end it; a band without x holds y alone.
    y[unbounded] = HUGE
    y = np.minimum(y, np.where(np.isinf(e), 1.0 / np.maximum(np.abs(bands.B), 1.0 / HUGE), HUGE).min(axis=1))
    y = _back(e, f, y)
    return np.where(y >= HUGE, np.inf, (e + f * y[:, None]).min(axis=1)), y


def _back(e: Floats, f: Floats, y: Floats) -> Floats:
    """Return the y, at most that given, at which the upper sides e + f y of all bands are above all lower sides.

    Their distance is a concave function, which is not negative at 0: Newton's method comes down on its end.
    """
    y = y.copy()
    at = np.arange(len(y))
    for _ in range(2 * e.shape[1]):
        upper, lower = e[at] + f[at] * y[at, None], f[at] * y[at, None] - e[at]
        i, j = upper.argmin(axis=1), lower.argmax(axis=1)
        rows = np.arange(len(at))
        crossed = lower[rows, j] > upper[rows, i] + ROUNDING * np.abs(upper[rows, i])
        at, i, j = at[crossed], i[crossed], j[crossed]
        if not len(at):
            break
        y[at] = np.maximum((e[at, i] + e[at, j]) / (f[at, j] - f[at, i]), 0.0)
    return y


def controllable(bands: Bands, end: tuple[float, float], stops: NDArray[np.bool_]) -> Controllable:
    """Return the squared speeds from which the end can be reached, by a backward pass.

    Parameters
    ----------
    bands : Bands
    end : (float, float)
        Least and most squared speed at the end.
    stops : ndarray of bool, shape (N+1,)
        Grid points at which the speed must be zero.

    Notes
    -----
    The largest x over y is a concave function, so with y in an interval it is taken at its top or at the nearer end.
    """
    N = len(bands.A)
    top, at = tops(bands)
    rush = RUSH * float(np.median(top))
    top = np.where(stops[:-1], 0.0, np.minimum(top, rush))
    e, f = solved_for(bands.A, bands.B)
    least, most = np.zeros(N + 1), np.zeros(N + 1)
    low, high = end[0], max(end[0], min(end[1], rush))
    least[N], most[N] = low, high
    caps, places = top.tolist(), at.tolist()
    for k in range(N - 1, -1, -1):
        if places[k] > high:
            x = float((e[k] + f[k] * high).min())
        elif places[k] < low:
            x = float((e[k] + f[k] * low).min())
        else:
            x = caps[k]
        low = max(0.0, float((f[k] * low - e[k]).max())) if low > 0.0 else 0.0
        high = min(x, caps[k])
        least[k], most[k] = low, high
    return Controllable(least, most)


def fastest_speeds(bands: Bands, sets: Controllable, start: float) -> Floats:
    """Return the largest squared speeds from a start that is controllable, (N+1,), by a pass forward."""
    N = len(bands.A)
    e, f = solved_for(bands.B, bands.A)
    found = [start]
    least, most = sets.least.tolist(), sets.most.tolist()
    x = start
    for k in range(N):
        y = min(most[k + 1], float((e[k] + f[k] * x).min()))
        # Below only by rounding.
        x = max(y, least[k + 1])
        found.append(x)
    return np.array(found)
