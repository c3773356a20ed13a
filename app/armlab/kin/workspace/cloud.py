"""The reachable workspace WS1 as a cloud: random configurations inside the limits and where the tool is in each.

Samples are uniform in the joint values, so the cloud is dense where many configurations lead, not where the workspace
is large; what has a low density may still be a part of it (notes, section 4.2; volumes: `section`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.workspace.measures import measure_named

Array = NDArray[np.floating]
Singles = NDArray[np.float32]

CHUNK = 65_536
"""Largest number of samples in one piece: some 15 ms of work, and the memory held at a time."""

FIRST = 4_096
"""Largest number of samples in the first piece, so that something is soon visible."""

SINGLE = 4e-6
"""Error of a point in single precision, relative to the reach plus the distance of the base."""


class Samples(NamedTuple):
    """Configurations with their tool points.

    Attributes
    ----------
    q : ndarray, shape (k, n), float32
        Rad or m, inside the limits.
    points : ndarray, shape (k, 3), float32
        The tool point of each in the world, metres; exact to `SINGLE`.
    values : ndarray, shape (k,), float32
        The measure of each.
    """

    q: Singles
    points: Singles
    values: Singles


def samples(
    arm: Arm, count: int, seed: int = 0, measure: str = "manipulability", chunk: int = CHUNK
) -> Iterator[Samples]:
    """Yield random configurations with their tool points and a measure, piece by piece.

    Parameters
    ----------
    arm : Arm
    count : int
        Samples in all; the memory does not grow with it.
    seed : int
        The same seed gives the same samples in the same order, whatever the chunks, and the first of many samples
        are those of few.
    measure : str
        Key of `armlab.kin.workspace.measures`.
    chunk : int
        Samples of a piece at most; the measure may ask for smaller ones.

    Yields
    ------
    Samples

    Raises
    ------
    InputError
        A count or chunk below 1, or an unknown measure; at once, not with the first piece.
    """
    for name, number in (("count", count), ("chunk", chunk)):
        if number < 1:
            raise InputError(f"{name}: expected at least 1, got {number}")
    measured = measure_named(measure)
    return _pieces(arm, count, seed, measured.values, min(chunk, measured.piece))


def _pieces(arm: Arm, count: int, seed: int, values_of: Callable[[Arm, Array], Array], chunk: int) -> Iterator[Samples]:
    rng = np.random.default_rng(seed)
    low, high = single_limits(arm)
    span, done, size = high - low, 0, min(FIRST, chunk)
    while done < count:
        q = rng.random((min(size, count - done), arm.n), dtype=np.float32)
        q *= span
        q += low
        np.minimum(q, high, out=q)
        yield Samples(q, arm.position(q), values_of(arm, q))
        done, size = done + len(q), chunk


def single_limits(arm: Arm) -> tuple[Singles, Singles]:
    """Return the smallest and largest joint values (n,) in single precision that are inside the limits.

    Where not one number in single precision lies between two limits, it is the nearest to them.
    """
    low, high = arm.limits.T.astype(np.float32)
    low = np.where(low < arm.limits[:, 0], np.nextafter(low, np.float32(np.inf)), low)
    high = np.where(high > arm.limits[:, 1], np.nextafter(high, np.float32(-np.inf)), high)
    middle = arm.limits.mean(axis=1).astype(np.float32)
    none = low > high
    return np.where(none, middle, low), np.where(none, middle, high)
