"""The polynomial of least degree with given derivatives at both ends of [0, 1]."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_DEGREE = 15
"""Largest degree: higher ones lose more than the last six digits in powers of s, and oscillate without use."""


def boundary_polynomial(start: Sequence[Floats], end: Sequence[Floats]) -> Floats:
    """Return coefficients in rising powers of s, shape (d+1, m).

    Parameters
    ----------
    start, end : sequences of ndarray, shape (m,)
        Value, first derivative, second, ... with respect to s, at s = 0 and at s = 1. Their numbers may differ; the
        degree d is one less than their sum.

    Notes
    -----
    The coefficients of the low powers are Taylor's; the others solve as many equations at s = 1.
    """
    known, count = len(start), len(start) + len(end)
    factorials = np.array([float(math.factorial(k)) for k in range(known)])
    low = np.array(start) / factorials[:, None]
    matrix = np.array([[float(math.perm(k, j)) for k in range(count)] for j in range(len(end))])
    right = np.array(end) - matrix[:, :known] @ low
    return np.concatenate([low, np.linalg.solve(matrix[:, known:], right)])


def in_seconds(values: Sequence[Floats], duration: float) -> list[Floats]:
    """Return derivatives with respect to s from those with respect to t = s T: the k-th is multiplied by T^k."""
    return [value * duration**k for k, value in enumerate(values)]
