"""Extreme values of a piecewise smooth function, and the intervals where it exceeds a limit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from armlab.kin.motion.series import Function, Series, roots_inside, series_of

Floats = NDArray[np.float64]

FINER = 4
"""Number of grid points for each degree of a polynomial."""

BETWEEN = 1.0 / math.cos(math.pi / (2.0 * FINER))
"""Largest ratio of a polynomial of degree d to its values on d * `FINER` + 1 Chebyshev points (Ehlich and Zeller 1964),
which makes the search certain."""

MANY, FINEST = 8, 64
"""Number of pieces that may hold an extreme above which they are examined on grids 8 times as fine, and again, up to
the second number, before roots are found: for a motion that is at its limit all the time these may be nearly all
pieces."""

GAIN = 1e-15
"""Relative gain below which a better extreme is not sought."""

SLACK = 1e-9
"""Relative excess over a limit that is ignored: a motion scaled to meet a limit meets it only up to rounding."""


@dataclass(frozen=True, eq=False)
class Extremes:
    """The range of each of m components.

    Attributes
    ----------
    lowest, highest : ndarray, shape (m,)
    lowest_at, highest_at : ndarray, shape (m,)
        Arguments at which they are taken; the first ones found.
    """

    lowest: Floats
    highest: Floats
    lowest_at: Floats
    highest_at: Floats

    @property
    def peak(self) -> Floats:
        """The largest absolute value of each component, shape (m,)."""
        return np.maximum(np.abs(self.lowest), np.abs(self.highest))

    @property
    def peak_at(self) -> Floats:
        """The argument of the largest absolute value of each component, shape (m,)."""
        return np.where(np.abs(self.highest) >= np.abs(self.lowest), self.highest_at, self.lowest_at)


def extremes(function: Function, edges: Floats, degree: int | None = None) -> Extremes:
    """Return the exact range of a function that is smooth between edges; jumps count from both sides.

    Parameters
    ----------
    function : callable
        A function from (N,) to (N, m).
    edges : ndarray, shape (P+1,)
    degree : int, optional
        Degree of the polynomials between the edges, if the function consists of these; see
        `armlab.kin.motion.series.series_of`.
    """
    return extremes_of_series(series_of(function, edges, degree))


def extremes_of_series(series: Series) -> Extremes:
    """Return the range of series; see `extremes`."""
    degree = max(series.coefficients.shape[1] - 1, 1)
    count = FINER * degree + 1
    values, places = series.on_grid(count), series.grid(count)
    top, bottom = values.max(axis=1), values.min(axis=1)
    m = values.shape[2]
    found = np.empty((4, m))
    for j in range(m):
        found[:2, j] = _highest(series, j, 1.0, (values[:, :, j], top[:, j], bottom[:, j]), places)
        found[2:, j] = _highest(series, j, -1.0, (-values[:, :, j], -bottom[:, j], -top[:, j]), places)
    return Extremes(-found[2], found[0], found[3], found[1])


def _highest(
    series: Series, j: int, sign: float, grid: tuple[Floats, Floats, Floats], places: Floats
) -> tuple[float, float]:
    """Return the largest value of sign times component j, and its argument."""
    values, top, bottom = grid
    piece = int(np.argmax(top))
    point = int(np.argmax(values[piece]))
    best, best_at = float(top[piece]), float(places[piece, point])
    bound = 0.5 * (top + bottom) + 0.5 * (top - bottom) * BETWEEN
    candidates = np.flatnonzero(bound > best + GAIN * (abs(best) + np.abs(bound)))
    for factor in (8, FINEST):
        if len(candidates) > MANY:
            finer, top, bottom = _finer(series, j, candidates, factor)
            top, bottom = (top, bottom) if sign > 0.0 else (-bottom, -top)
            k = int(np.argmax(top))
            if top[k] > best:
                point = int(np.argmax(sign * finer[k]))
                best = float(top[k])
                best_at = float(series.grid(finer.shape[1])[candidates[k], point])
            bound[candidates] = 0.5 * (top + bottom) + 0.5 * (top - bottom) * _between(factor)
            candidates = candidates[bound[candidates] > best + GAIN * (abs(best) + np.abs(bound[candidates]))]
    for i in candidates[np.argsort(-bound[candidates], kind="stable")]:
        if bound[i] <= best:
            break
        terms = sign * series.coefficients[i, :, j]
        turns = roots_inside(np.asarray(chebyshev.chebder(terms), dtype=np.float64))
        for u, value in zip(turns, np.atleast_1d(chebyshev.chebval(turns, terms)), strict=True):
            if value > best:
                best, best_at = float(value), _place(series.edges[i], float(u))
    return best, best_at


def _finer(series: Series, j: int, pieces: NDArray[np.int_], factor: int) -> tuple[Floats, Floats, Floats]:
    """Return component j of some pieces on a finer grid, (P, count), and its extreme values there, (P,)."""
    degree = max(series.coefficients.shape[1] - 1, 1)
    some = Series(series.edges[pieces], series.coefficients[pieces, :, j : j + 1])
    values = some.on_grid(FINER * factor * degree + 1)[:, :, 0]
    return values, values.max(axis=1), values.min(axis=1)


def _between(factor: int) -> float:
    """Return the factor `BETWEEN` for a grid ``factor`` times as fine."""
    return 1.0 / math.cos(math.pi / (2.0 * FINER * factor))


def _place(edges: Floats, u: float) -> float:
    low, high = float(edges[0]), float(edges[1])
    return float(low + (high - low) * (0.5 + 0.5 * u))


def exceeding(series: Series, limits: Floats) -> list[list[tuple[float, float]]]:
    """Return for each component the intervals where its absolute value is above its limit by more than `SLACK`.

    Parameters
    ----------
    series : Series
        m components.
    limits : ndarray, shape (m,)
        Positive or infinite.
    """
    return [_above(series, j, float(limit) * (1.0 + SLACK)) for j, limit in enumerate(limits)]


def outside(series: Series, low: Floats, high: Floats, slack: float) -> list[list[tuple[float, float]]]:
    """Return for each component the intervals where it is below ``low`` or above ``high`` by more than ``slack``."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    shifted = series.coefficients.copy()
    shifted[:, 0] -= middle
    moved = Series(series.edges, shifted)
    return [_above(moved, j, float(reach) + slack) for j, reach in enumerate(half)]


def _above(series: Series, j: int, limit: float) -> list[tuple[float, float]]:
    if math.isinf(limit):
        return []
    degree = max(series.coefficients.shape[1] - 1, 1)
    column = Series(series.edges, series.coefficients[:, :, j : j + 1]).on_grid(FINER * degree + 1)[:, :, 0]
    top, bottom = column.max(axis=1), column.min(axis=1)
    spread = 0.5 * (top - bottom) * BETWEEN
    middle = 0.5 * (top + bottom)
    intervals: list[tuple[float, float]] = []
    candidates = np.flatnonzero(np.abs(middle) + spread > limit)
    for factor in (8, FINEST):
        if len(candidates) > MANY:
            _, top, bottom = _finer(series, j, candidates, factor)
            reach = 0.5 * np.abs(top + bottom) + 0.5 * (top - bottom) * _between(factor)
            candidates = candidates[reach > limit]
    for i in candidates:
        terms = series.coefficients[i, :, j]
        cuts = np.concatenate([[-1.0, 1.0], _crossings(terms, limit), _crossings(terms, -limit)])
        cuts = np.unique(cuts)
        for low, high in pairwise(cuts.tolist()):
            if abs(float(chebyshev.chebval(0.5 * (low + high), terms))) > limit:
                _append(intervals, _place(series.edges[i], low), _place(series.edges[i], high))
    return intervals


def _crossings(terms: Floats, level: float) -> Floats:
    shifted = terms.copy()
    shifted[0] -= level
    return roots_inside(shifted)


def _append(intervals: list[tuple[float, float]], low: float, high: float) -> None:
    """Append an interval; one that touches the last is joined with it."""
    if intervals and low - intervals[-1][1] <= 1e-9 * max(abs(low), high - low):
        intervals[-1] = (intervals[-1][0], high)
    else:
        intervals.append((low, high))
