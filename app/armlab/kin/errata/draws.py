"""Seeded random inputs of the trials: well-conditioned, and clear of the special cases."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.rotations import rotation_from_axis_angle

Floats = NDArray[np.float64]
Generator = np.random.Generator


def signed(rng: Generator, low: float, high: float, size: int | None = None) -> Floats:
    """Return numbers of either sign with magnitudes between two bounds."""
    return np.asarray(rng.uniform(low, high, size) * rng.choice((-1.0, 1.0), size))


def either(rng: Generator, *ranges: tuple[float, float]) -> float:
    """Return a number of one of some ranges, each as likely as the others."""
    low, high = ranges[rng.integers(len(ranges))]
    return float(rng.uniform(low, high))


def direction(rng: Generator, n: int = 3) -> Floats:
    """Return a vector of length 1."""
    v = rng.normal(size=n)
    return np.asarray(v / np.linalg.norm(v))


def rotation(rng: Generator, low: float = 0.3, high: float = 2.8) -> Floats:
    """Return a rotation about any axis by an angle between two bounds, radians, shape (3, 3)."""
    return np.asarray(rotation_from_axis_angle(direction(rng), rng.uniform(low, high)), dtype=np.float64)


def orthogonal(rng: Generator, n: int) -> Floats:
    """Return an orthogonal matrix, shape (n, n)."""
    Q, _ = np.linalg.qr(rng.normal(size=(n, n)))
    return np.asarray(Q)


def matrix(rng: Generator, m: int, n: int, low: float = 0.5, high: float = 2.0) -> Floats:
    """Return a matrix of full rank whose singular values lie between two bounds, shape (m, n)."""
    k = min(m, n)
    sigma = rng.uniform(low, high, k)
    return np.asarray(orthogonal(rng, m)[:, :k] * sigma @ orthogonal(rng, n)[:k])


def two_links(rng: Generator) -> tuple[float, float, float, float]:
    """Return lengths, metres, and joint values, radians, of a planar 2R that is neither stretched nor folded."""
    l1, l2 = rng.uniform(0.5, 1.5, 2).tolist()
    return l1, l2, float(rng.uniform(-3.0, 3.0)), float(signed(rng, 0.4, 2.6))
