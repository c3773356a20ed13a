"""Chebyshev series piece by piece: the form in which extremes, roots and integrals of any motion are found.

Between neighbouring breaks a motion is smooth. Where it is a polynomial of known degree the series is exact; elsewhere
pieces are halved until the last coefficients vanish (Trefethen, *Approximation Theory and Approximation Practice*,
chapters 3, 8 and 18).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]
"""A function from (N,) arguments to (N, m) values."""

COUNT = 21
"""Number of coefficients of a piece of unknown degree."""

TAIL = 1e-14
"""Size of the last coefficients, relative to the largest value, at which a piece is resolved."""

NOISE = 1e-9
"""Size of the last coefficients, likewise, below which they are rounding if halving the piece does not reduce them."""

HALVINGS = 40
"""Largest number of halvings of a piece: a kink is then located to 1e-12 of it."""

MOST_PIECES = 20_000
"""Largest number of unresolved pieces at a time; beyond it they stay as they are (the tail is rounding)."""


@dataclass(frozen=True, eq=False)
class Series:
    """Chebyshev series of a function with m components.

    Attributes
    ----------
    edges : ndarray, shape (P, 2)
        Ends of each piece, sorted.
    coefficients : ndarray, shape (P, n, m)
        Chebyshev coefficients in x mapped to [-1, 1].
    """

    edges: Floats
    coefficients: Floats

    def on_grid(self, count: int) -> Floats:
        """Return values at Chebyshev points of each piece, ends included, shape (P, count, m)."""
        grid = _lobatto(count)
        return np.asarray(np.matmul(_basis(count, self.coefficients.shape[1], grid.tobytes()), self.coefficients))

    def grid(self, count: int) -> Floats:
        """Return the arguments of `on_grid`, shape (P, count)."""
        low, high = self.edges[:, :1], self.edges[:, 1:]
        places: Floats = low + (high - low) * (0.5 + 0.5 * _lobatto(count))
        places[:, -1:] = high
        return places

    def at(self, x: Floats) -> Floats:
        """Return values, shape (N, m); arguments outside are evaluated on the first or last piece."""
        index = np.searchsorted(self.edges[1:, 0], x, side="right")
        low, high = self.edges[index].T
        u = (2.0 * x - low - high) / (high - low)
        return _clenshaw(self.coefficients[index], u[:, None])

    def integral(self) -> Series:
        """Return the integral from the first edge on."""
        half = np.diff(self.edges, axis=1)[:, :, None] / 2.0
        padded = np.moveaxis(self.coefficients, 1, 0)
        raised = np.moveaxis(chebyshev.chebint(padded, lbnd=-1.0), 0, 1) * half
        ends = raised.sum(axis=1)
        raised[1:, 0] += np.cumsum(ends, axis=0)[:-1]
        return Series(self.edges, raised)


def series_of(function: Function, edges: Floats, degree: int | None = None) -> Series:
    """Return the series of a function that is smooth between edges.

    Parameters
    ----------
    function : callable
        See `Function`; never called at an edge.
    edges : ndarray, shape (P+1,)
        Increasing.
    degree : int, optional
        Degree of the polynomials between the edges, if the function consists of these.
    """
    pieces = np.stack([edges[:-1], edges[1:]], axis=1)
    if degree is not None and degree < COUNT:
        return Series(pieces, _fitted(function, pieces, degree + 1))
    done_edges, done_coefficients = [], []
    largest = 0.0
    before = np.full(len(pieces), np.inf)
    for _ in range(HALVINGS):
        coefficients = _fitted(function, pieces, COUNT)
        largest = max(largest, float(np.abs(coefficients).sum(axis=1).max(initial=0.0)))
        tail = np.abs(coefficients[:, -3:]).max(axis=(1, 2))
        rough = (tail > TAIL * largest) & ((tail > NOISE * largest) | (tail < 0.25 * before))
        if 2 * int(rough.sum()) > MOST_PIECES:
            rough[:] = False
        done_edges.append(pieces[~rough])
        done_coefficients.append(coefficients[~rough])
        if not rough.any():
            break
        before = np.repeat(tail[rough], 2)
        low, high = pieces[rough].T
        middle = 0.5 * (low + high)
        pieces = np.stack([np.stack([low, middle], axis=1), np.stack([middle, high], axis=1)]).reshape(-1, 2)
    else:
        done_edges.append(pieces)
        done_coefficients.append(_fitted(function, pieces, COUNT))
    every = np.concatenate(done_edges)
    order = np.argsort(every[:, 0])
    return Series(every[order], np.concatenate(done_coefficients)[order])


def _fitted(function: Function, pieces: Floats, count: int) -> Floats:
    nodes = np.cos(np.pi * (np.arange(count)[::-1] + 0.5) / count)
    low, high = pieces[:, :1], pieces[:, 1:]
    places = low + (high - low) * (0.5 + 0.5 * nodes)
    values = function(places.reshape(-1))
    to_coefficients = np.cos(np.outer(np.arange(count), np.arccos(nodes))) * (2.0 / count)
    to_coefficients[0] *= 0.5
    return np.asarray(np.matmul(to_coefficients, values.reshape(len(pieces), count, -1)))


def _lobatto(count: int) -> Floats:
    return np.asarray(-np.cos(np.pi * np.arange(count) / (count - 1)))


@cache
def _basis(count: int, terms: int, grid: bytes) -> Floats:
    return np.asarray(chebyshev.chebvander(np.frombuffer(grid), terms - 1))


def _clenshaw(coefficients: Floats, u: Floats) -> Floats:
    """Return sums over (N, n, m) coefficients at (N, 1) arguments."""
    first = np.zeros_like(coefficients[:, 0])
    second = first
    for k in range(coefficients.shape[1] - 1, 0, -1):
        first, second = coefficients[:, k] + 2.0 * u * first - second, first
    return coefficients[:, 0] + u * first - second


def roots_inside(coefficients: Floats) -> Floats:
    """Return the real roots in [-1, 1] of one series, shape (n,); none of a constant."""
    size = np.abs(coefficients).max(initial=0.0)
    significant = np.flatnonzero(np.abs(coefficients) > 1e-15 * size)
    if size == 0.0 or len(significant) == 0 or significant[-1] == 0:
        return np.zeros(0)
    roots = np.asarray(chebyshev.chebroots(coefficients[: significant[-1] + 1]), dtype=complex)
    # A double root comes as a pair beside the real line, as far as the root of the rounding.
    real = roots.real[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1.0 + 1e-9)]
    return np.asarray(np.clip(np.sort(real), -1.0, 1.0), dtype=np.float64)
