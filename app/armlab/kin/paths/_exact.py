"""A polynomial known exactly, evaluated about the middle of [0, 1], where its coefficients hardly cancel.

In powers of s one of degree 15 between two rests has coefficients of 1e5 whose sum is 1: six digits are lost, and how
they are lost depends on the order of a sum, which processors choose. In powers of 2 s - 1 they are below 100. Derived
and moved there in fractions, each is rounded once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.breaks import ORDERS
from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]
Rows = Sequence[Sequence[Fraction]]
"""Coefficients of each coordinate, in rising powers."""


class ExactPolynomial(PolynomialPath):
    """One polynomial over [0, 1].

    Parameters
    ----------
    rows : sequence of m sequences of d + 1 Fraction
        Coefficients in rising powers of s.
    duration : float
    """

    def __init__(self, rows: Rows, duration: float) -> None:
        plain = np.array([[float(value) for value in row] for row in rows]).T
        super().__init__(Piecewise(np.array([0.0, 1.0]), plain[None]), duration)
        centred = [_centred(row) for row in rows]
        self._orders = [np.array([_derived(row, order) for row in centred]).T for order in ORDERS]

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        u = (2.0 * s - 1.0)[..., None]
        found = []
        for order in orders:
            terms = self._orders[order]
            # Number by number, without sums of products whose order a processor may choose.
            value = np.broadcast_to(terms[-1], (*s.shape, self.m)).copy()
            for row in terms[-2::-1]:
                value *= u
                value += row
            found.append(value)
        return found


def _centred(row: Sequence[Fraction]) -> list[Fraction]:
    """Return coefficients in powers of u = 2 s - 1: s^k = (1 + u)^k / 2^k."""
    count = len(row)
    halved = [value / 2**k for k, value in enumerate(row)]
    return [sum((math.comb(k, j) * halved[k] for k in range(j, count)), Fraction(0)) for j in range(count)]


def _derived(row: Sequence[Fraction], order: int) -> list[float]:
    """Return the coefficients of a derivative with respect to s, each rounded once; one zero for a constant."""
    if order >= len(row):
        return [0.0]
    return [float(2**order * math.perm(j, order) * row[j]) for j in range(order, len(row))]


def boundary_fractions(start: Sequence[Fraction], end: Sequence[Fraction]) -> list[Fraction]:
    """Return the exact polynomial of one coordinate with given derivatives at both ends, in rising powers of s.

    Parameters
    ----------
    start, end : sequence of Fraction
        Value, first derivative, ... with respect to s; see `armlab.kin.paths._boundary.boundary_polynomial`.
    """
    low = [value / math.factorial(k) for k, value in enumerate(start)]
    left = [value - sum(math.perm(k, j) * a for k, a in enumerate(low)) for j, value in enumerate(end)]
    inverse = _inverse(len(start), len(end))
    high = [sum((a * b for a, b in zip(row, left, strict=True)), Fraction(0)) for row in inverse]
    return [*low, *high]


@cache
def _inverse(known: int, count: int) -> list[list[Fraction]]:
    """Return the inverse of the derivatives of s^known, s^(known+1), ... at s = 1, by Gauss's elimination."""
    rows = [
        [Fraction(math.perm(known + k, j)) for k in range(count)] + [Fraction(int(i == j)) for i in range(count)]
        for j in range(count)
    ]
    for k in range(count):
        pivot = next(i for i in range(k, count) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [value / rows[k][k] for value in rows[k]]
        for i in range(count):
            if i != k and rows[i][k]:
                rows[i] = [a - rows[i][k] * b for a, b in zip(rows[i], rows[k], strict=True)]
    return [row[count:] for row in rows]
