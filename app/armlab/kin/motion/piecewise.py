"""Piecewise polynomials with vector coefficients, of which most paths and laws are made."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SAMPLES_A_PIECE = 40
"""Number of sorted samples in a piece from which evaluating piece by piece is the faster way."""

SHORTEST = 1e-13
"""Length of a piece, relative to the whole, below which it is only rounding."""


@dataclass(frozen=True, eq=False)
class Piecewise:
    """A function of one variable with m components, a polynomial of degree d between neighbouring knots.

    Attributes
    ----------
    knots : ndarray, shape (k+1,)
        Increasing.
    coefficients : ndarray, shape (k, d+1, m)
        Coefficients of piece i, in rising powers of ``x - knots[i]``: the a_ki of the notes (6.89, 6.97).
    """

    knots: Floats
    coefficients: Floats
    _derived: dict[int, Floats] = field(default_factory=dict, init=False, repr=False)

    @property
    def degree(self) -> int:
        """The degree d."""
        return int(self.coefficients.shape[1]) - 1

    def at(self, x: Floats, orders: Sequence[int], before: bool = False) -> list[Floats]:
        """Return derivatives of the given orders, each of shape (..., m).

        Parameters
        ----------
        x : ndarray, shape (...)
            Outside of the knots the first and last piece go on.
        orders : sequence of int
        before : bool
            Whether to take, at a knot, the piece that ends there instead of the one that begins.
        """
        flat = x.reshape(-1)
        m = self.coefficients.shape[2]
        return [values.reshape(*x.shape, m) for values in self._flat(flat, orders, before)]

    def _flat(self, x: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        pieces = len(self.coefficients)
        if pieces == 1:
            return [self._whole(x - self.knots[0], self._of_order(order)[0]) for order in orders]
        if len(x) >= SAMPLES_A_PIECE * pieces and not before and bool((x[1:] >= x[:-1]).all()):
            return self._runs(x, orders)
        index = np.searchsorted(self.knots[1:-1], x, side="left" if before else "right")
        u = (x - self.knots[index])[:, None]
        gathered = self.coefficients[index]
        return [_horner(gathered, u, order) for order in orders]

    @staticmethod
    def _whole(u: Floats, coefficients: Floats) -> Floats:
        """Return values of one polynomial; of a constant only a view, without a copy for each sample."""
        if len(coefficients) == 1:
            return np.broadcast_to(coefficients[0], (len(u), coefficients.shape[1]))
        return np.asarray((coefficients.T @ _powers(u, 0, len(coefficients) - 1)).T)

    def _runs(self, x: Floats, orders: Sequence[int]) -> list[Floats]:
        """Evaluate sorted samples, the run of each piece as one product of matrices.

        The samples of a component lie side by side in memory, so what is done with them later runs along them.
        """
        cuts = [0, *np.searchsorted(x, self.knots[1:-1], side="left").tolist(), len(x)]
        found = [np.empty((self.coefficients.shape[2], len(x))) for _ in orders]
        for i, (first, last) in enumerate(pairwise(cuts)):
            if first == last:
                continue
            powers = _powers(x[first:last] - self.knots[i], min(orders), self.degree)
            for order, out in zip(orders, found, strict=True):
                derived = self._of_order(order)[i]
                np.matmul(derived.T, powers[: len(derived)], out=out[:, first:last])
        return [out.T for out in found]

    def _of_order(self, order: int) -> Floats:
        """Return the coefficients of a derivative, (k, max(d + 1 - order, 1), m)."""
        if order == 0:
            return self.coefficients
        if order not in self._derived:
            lower = self._of_order(order - 1)
            count = lower.shape[1]
            derived = lower[:, 1:] * np.arange(1.0, count)[:, None] if count > 1 else np.zeros_like(lower)
            self._derived[order] = np.ascontiguousarray(derived)
        return self._derived[order]

    def local(self, unit: float) -> Piecewise:
        """Return the same function of ``x * unit``: knots multiplied, coefficients scaled."""
        scales = unit ** -np.arange(self.degree + 1.0)
        return Piecewise(self.knots * unit, self.coefficients * scales[:, None])


def _powers(u: Floats, order: int, degree: int) -> Floats:
    """Return 1, u, u^2, ... as rows, as many as the derivative of this order has coefficients."""
    count = max(degree + 1 - order, 1)
    rows = np.empty((count, len(u)))
    rows[0] = 1.0
    for k in range(1, count):
        np.multiply(rows[k - 1], u, out=rows[k])
    return rows


def _horner(coefficients: Floats, u: Floats, order: int) -> Floats:
    """Return a derivative of sums over (N, count, m) coefficients at (N, 1) arguments."""
    last = coefficients.shape[1] - 1
    value: Floats = coefficients[:, last] * float(math.perm(last, order))
    for k in range(last - 1, order - 1, -1):
        value *= u
        value += coefficients[:, k] if order == 0 else coefficients[:, k] * float(math.perm(k, order))
    return value


def integrated(durations: Sequence[float], highest: Sequence[float], start: Sequence[float]) -> Piecewise:
    """Return s(t) whose derivative of order ``len(start)`` is piecewise constant.

    Parameters
    ----------
    durations : sequence of float
        Durations of the pieces, seconds. One that is zero up to rounding is left out, and its effect is a jump.
    highest : sequence of float
        The constant of each piece.
    start : sequence of float
        s, s', ... at t = 0.
    """
    least = SHORTEST * sum(durations)
    order = len(start)
    state = np.array(start, dtype=float)
    factorials = np.cumprod([1.0, *range(1, order + 1)])
    rows, kept = [], []
    for h, value in zip(durations, highest, strict=True):
        taylor = np.append(state, value)
        if h > least:
            rows.append(taylor / factorials)
            kept.append(h)
        for k in range(order):
            powers = h ** np.arange(order + 1 - k)
            state[k] = np.sum(taylor[k:] * powers / factorials[: order + 1 - k])
    knots = np.concatenate([[0.0], np.cumsum(kept)])
    return Piecewise(knots, np.array(rows)[:, :, None])
