"""A curve in space typed as three functions of s, converted to a path with derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from armlab.content.expressions import Expression, parse
from armlab.errors import InputError
from armlab.kin.motion.path import Path

Floats = NDArray[np.float64]

COUNT = 17
"""Number of coefficients of a piece."""

TAIL = 1e-13
"""Size of the last coefficients of a piece, relative to the largest of its coordinate, at which it is resolved; smaller
ones than a tenth of it are rounding and left out, so that a polynomial keeps its degree."""

SHORTEST = 1e-6
"""Length of a piece, in s, below which it holds a corner if it is still not resolved; a straight line replaces it."""

MOST_PLACES = 1400
"""Largest number of values of s at which the functions are evaluated; a corner takes 700."""

EXACT_DEGREE = 12
"""Largest degree of a single series that counts as the typed polynomial."""

FARTHEST = 1e4
"""Largest absolute value of a coordinate, metres."""

AXES = "xyz"

REMARK = "The derivatives are those of a Chebyshev series of the typed functions: right to about eight digits."


class FormulaPath(Path):
    """Chebyshev series piece by piece.

    Parameters
    ----------
    edges : ndarray, shape (P+1,)
        From 0 to 1.
    coefficients : ndarray, shape (P, n, 3)
    """

    def __init__(self, edges: Floats, coefficients: Floats) -> None:
        self.m, self.pieces = 3, edges[1:-1]
        self._edges = edges
        self._orders = [coefficients]
        for _ in range(3):
            factor = (2.0 / np.diff(edges))[:, None, None]
            self._orders.append(np.asarray(chebyshev.chebder(self._orders[-1], axis=1)) * factor)
        degree = coefficients.shape[1] - 1
        polynomial = len(edges) == 2 and degree <= EXACT_DEGREE
        self.degree = degree if polynomial else None
        self.remarks = () if polynomial else (REMARK,)

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        flat = s.reshape(-1)
        index = np.searchsorted(self.pieces, flat, side="left" if before else "right")
        low, high = self._edges[index], self._edges[index + 1]
        u = ((2.0 * flat - low - high) / (high - low))[:, None]
        return [_summed(self._orders[order][index], u).reshape(*s.shape, 3) for order in orders]


def _summed(terms: Floats, u: Floats) -> Floats:
    """Return sums over (N, n, 3) coefficients at (N, 1) arguments, by Clenshaw's rule."""
    first = np.zeros_like(terms[:, 0])
    second = first
    for k in range(terms.shape[1] - 1, 0, -1):
        first, second = terms[:, k] + 2.0 * u * first - second, first
    return np.asarray(terms[:, 0] + u * first - second)


@lru_cache(maxsize=64)
def formula_path(texts: tuple[str, str, str]) -> FormulaPath:
    """Return the curve of three formulas in s, metres, over s from 0 to 1.

    Each is written as Chebyshev series on pieces that are halved until the last coefficients vanish: a polynomial up to
    rounding, everything else with derivatives far better than differences.

    Raises
    ------
    InputError
        A formula that cannot be read or has no value somewhere (the text names the coordinate), or one that changes too
        quickly.
    """
    expressions = [_read(text, axis) for text, axis in zip(texts, AXES, strict=True)]
    for s in (0.0, 0.5, 1.0):
        _value(expressions, s)
    low, high = np.zeros(1), np.ones(1)
    done: list[tuple[float, float, Floats]] = []
    places, largest = 0, np.zeros(3)
    while len(low):
        places += COUNT * len(low)
        if places > MOST_PLACES:
            raise InputError(
                f"curve: it changes too quickly near s = {low[0]:.3g} to be drawn; it needs a value and a direction "
                "everywhere from s = 0 to 1"
            )
        series = _series(expressions, low, high)
        largest = np.maximum(largest, np.abs(series).max(axis=(0, 1)))
        tails = np.abs(series[:, -3:]).max(axis=1) > TAIL * np.maximum(largest, 1e-300)
        rough = tails.any(axis=1)
        short = rough & (high - low < SHORTEST)
        series[short] = _bridge(series[short])
        kept = ~rough | short
        done += list(zip(low[kept].tolist(), high[kept].tolist(), series[kept], strict=True))
        middle = 0.5 * (low + high)
        low, high = (np.concatenate(ends)[np.tile(~kept, 2)] for ends in ((low, middle), (middle, high)))
    done.sort(key=lambda piece: piece[0])
    coefficients = np.array([piece[2] for piece in done])
    return FormulaPath(np.array([0.0, *(piece[1] for piece in done)]), _trimmed(coefficients, largest))


def _read(text: str, axis: str) -> Expression:
    try:
        return parse(text, ("s",))
    except InputError as refusal:
        raise InputError(f"{axis}(s): {refusal}") from None


def _value(expressions: Sequence[Expression], s: float) -> list[float]:
    found = []
    for expression, axis in zip(expressions, AXES, strict=True):
        try:
            value = expression.value({"s": s})
        except InputError as refusal:
            raise InputError(f"{axis}(s) at s = {s:.3g}: {refusal}") from None
        if abs(value) > FARTHEST:
            raise InputError(f"{axis}(s) at s = {s:.3g}: expected at most {FARTHEST:g} m either way, got {value:.3g}")
        found.append(value)
    return found


def _series(expressions: Sequence[Expression], low: Floats, high: Floats) -> Floats:
    """Return the coefficients on pieces, (P, COUNT, 3)."""
    nodes = np.cos(np.pi * (np.arange(COUNT)[::-1] + 0.5) / COUNT)
    places = low[:, None] + (high - low)[:, None] * (0.5 + 0.5 * nodes)
    values = np.array([_value(expressions, s) for s in places.ravel().tolist()]).reshape(len(low), COUNT, 3)
    to_coefficients = np.cos(np.outer(np.arange(COUNT), np.arccos(nodes))) * (2.0 / COUNT)
    to_coefficients[0] *= 0.5
    return np.asarray(np.matmul(to_coefficients, values))


def _bridge(series: Floats) -> Floats:
    """Return straight lines between the ends of pieces, (P, COUNT, 3)."""
    signs = (-1.0) ** np.arange(COUNT)
    start, end = (series * signs[:, None]).sum(axis=1), series.sum(axis=1)
    lines = np.zeros_like(series)
    lines[:, 0], lines[:, 1] = 0.5 * (start + end), 0.5 * (end - start)
    return lines


def _trimmed(coefficients: Floats, largest: Floats) -> Floats:
    """Return coefficients without rounding errors, and without the highest ones if they are all zero."""
    clean = np.where(np.abs(coefficients) <= 0.1 * TAIL * largest, 0.0, coefficients)
    there = np.flatnonzero(np.abs(clean).max(axis=(0, 2)))
    return clean[:, : int(there[-1]) + 1 if len(there) else 1]
