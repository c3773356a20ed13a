"""The order of a run: every worker begins with what takes longest, such as browsers, which wait half of the time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby, islice
from typing import TypeVar

T = TypeVar("T")


def ordered(items: Sequence[T], first: Callable[[T], bool], module: Callable[[T], object], workers: int) -> list[T]:
    """Return the items in an order in which each worker has some of the first ones at the head of its block.

    pytest-xdist gives each worker a block of the list, one after the other, and to one that has finished the end of
    another's. So what is only put at the head of the list is all done by the first worker.

    Parameters
    ----------
    items : sequence
    first : callable
        ``first(item)``: whether it is to be done first.
    module : callable
        ``module(item)``: the first ones of a module stay together, as they share what was opened for it.
    workers : int
        Their number, at least 1.
    """
    shares: list[list[T]] = [[] for _ in range(workers)]
    for _, group in groupby(filter(first, items), module):
        min(shares, key=len).extend(group)
    others = iter([item for item in items if not first(item)])
    found: list[T] = []
    for share, size in zip(shares, block_sizes(len(items), workers), strict=True):
        found += [*share, *islice(others, max(size - len(share), 0))]
    return [*found, *others]


def block_sizes(count: int, workers: int) -> list[int]:
    """Return how many of so many items xdist gives to each worker at the start."""
    return [(count + k) // workers for k in range(workers)]
