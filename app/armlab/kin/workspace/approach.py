"""Approach directions in bins of nearly equal size, and which of them were met in which cell of a grid.

A direction that was met is one that is possible somewhere in the cell; one that was not met may have been missed. So a
sampled coverage says "at least".
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm

Floats = NDArray[np.float64]

MOST = 64
"""Largest number of bins: the bits of one word."""

SEED, SAMPLES, UPRIGHT = 5, 128, 1e-9
"""Seed and number of the random configurations that tell whether the tool's z axis keeps its line, and the
tolerance."""


@dataclass(frozen=True, eq=False)
class Directions:
    """Bins of directions.

    Attributes
    ----------
    axes : ndarray, shape (count, 3)
        Unit vectors in the middle of the bins: over the sphere, or on the circle across z.
    circle : bool
        Whether they are on a circle.
    """

    axes: Floats
    circle: bool

    @property
    def count(self) -> int:
        """Number of directions."""
        return len(self.axes)

    def bins(self, directions: ArrayLike) -> NDArray[np.intp]:
        """Return the bin of each direction (..., 3), of any length: the one with the nearest axis, shape (...)."""
        given = np.asarray(directions)
        if self.circle:
            turns = np.arctan2(given[..., 1], given[..., 0]) / math.tau
            return np.asarray(np.floor(turns * self.count).astype(np.intp) % self.count)
        return np.asarray(np.argmax(given @ self.axes.T.astype(given.dtype), axis=-1))


@lru_cache(maxsize=8)
def directions(count: int = MOST, circle: bool = False) -> Directions:
    """Return bins over the sphere, or of equal angles on the circle across z.

    Raises
    ------
    InputError
        Not 2 to 64 bins.
    """
    if not 2 <= count <= MOST:
        raise InputError(f"count: expected 2 to {MOST} directions, got {count}")
    if not circle:
        return Directions(spread(count), False)
    angles = (np.arange(count) + 0.5) * math.tau / count
    return Directions(np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=-1), True)


def spread(count: int) -> Floats:
    """Return unit vectors spread evenly over the sphere, shape (count, 3): a Fibonacci lattice.

    References
    ----------
    Gonzalez 2010, *Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices*.
    """
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    across, angle = np.sqrt(1.0 - z * z), math.pi * (1.0 + math.sqrt(5.0)) * k
    return np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=-1)


@lru_cache(maxsize=32)
def keeps_upright(arm: Arm) -> bool:
    """Return whether the tool's z axis has one line in all configurations, as in a plane or of a SCARA.

    Its orientation then is the angle of its x axis about that line, and directions are counted on a circle.
    """
    rng = np.random.default_rng(SEED)
    low, high = arm.limits.T
    z = arm.fk(low + (high - low) * rng.random((SAMPLES, arm.n)))[:, :3, 2]
    return bool(np.abs(z @ z[0]).min() >= 1.0 - UPRIGHT)


_ONES = np.array([bin(byte).count("1") for byte in range(256)], dtype=np.intp)
"""Number of bits that are set in each byte."""


class Approaches:
    """Directions met in each cell of a grid, one bit each; the memory is that of the grid.

    Parameters
    ----------
    low : array_like, shape (d,)
        Corner of the grid, metres.
    step : float
        Edge of a cell, metres.
    shape : tuple of d ints
    bins : Directions
    """

    def __init__(self, low: ArrayLike, step: float, shape: tuple[int, ...], bins: Directions) -> None:
        self.low, self.step, self.shape, self.bins = np.asarray(low, dtype=np.float64), float(step), shape, bins
        self.met = np.zeros(math.prod(shape), dtype=np.uint64)

    def cells(self, points: ArrayLike) -> NDArray[np.intp]:
        """Return the flat index of the cell of each point (k, d), metres; -1 outside the grid."""
        index = np.floor((np.asarray(points, dtype=np.float64) - self.low) / self.step).astype(np.intp)
        inside = np.all((index >= 0) & (index < np.array(self.shape)), axis=-1)
        flat = np.ravel_multi_index(tuple(np.where(inside, index.T, 0)), self.shape)
        return np.where(inside, flat, -1)

    def add(self, points: ArrayLike, axes: ArrayLike) -> NDArray[np.intp]:
        """Mark the directions (k, 3) met at points (k, d), metres; return the cells, -1 for points outside."""
        cells = self.cells(points)
        inside = cells >= 0
        bits = np.uint64(1) << self.bins.bins(axes)[inside].astype(np.uint64)
        np.bitwise_or.at(self.met, cells[inside], bits)
        return cells

    @property
    def counts(self) -> NDArray[np.intp]:
        """Number of directions met in each cell, in the grid's shape."""
        return np.asarray(_ONES[self.met.view(np.uint8)].reshape(-1, 8).sum(axis=1).reshape(self.shape))

    @property
    def coverage(self) -> Floats:
        """Fraction of all directions met in each cell, 0 to 1, in the grid's shape."""
        return self.counts / self.bins.count
