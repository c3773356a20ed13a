"""An array that grows by blocks of rows: existing ones are not copied, so growing takes no time."""

from __future__ import annotations

from collections.abc import Iterator
from types import EllipsisType
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

Indices = NDArray[np.signedinteger[Any]]

ROOM = 1 << 18
"""Numbers in a block of which rows are allocated: 2 MiB, which takes a few milliseconds."""


class Rows:
    """An array (any number of rows, *shape), read and written at rows (...,) as an array is.

    Parameters
    ----------
    shape : tuple of int
        Shape of a row.
    size : int
        Rows of a block.
    fill : float
        Value in rows that were never written.
    """

    def __init__(self, shape: tuple[int, ...], size: int, fill: float = 0.0, dtype: DTypeLike = np.float64) -> None:
        self.shape, self.size, self.fill, self.dtype = shape, size, fill, np.dtype(dtype)
        self.blocks: list[NDArray[Any]] = []

    def __getitem__(self, rows: Indices) -> NDArray[Any]:
        found = np.empty((*rows.shape, *self.shape), self.dtype)
        for block, within, here in self.parts(rows):
            found[here] = block[within]
        return found

    def __setitem__(self, rows: Indices, values: NDArray[Any]) -> None:
        for block, within, here in self.parts(rows):
            block[within] = values[here]

    def at(self, rows: Indices, columns: Indices) -> NDArray[Any]:
        """Return the entries (k, ...) of rows (k,) in columns (k,)."""
        found = np.empty((len(rows), *self.shape[1:]), self.dtype)
        for block, within, here in self.parts(rows):
            found[here] = block[within, columns[here]]
        return found

    def first(self, count: int) -> NDArray[Any]:
        """Return a copy of the first ``count`` rows, (count, ...)."""
        return np.asarray(self[np.arange(count)])

    def parts(self, rows: Indices) -> Iterator[tuple[NDArray[Any], Indices, NDArray[np.bool_] | EllipsisType]]:
        """Yield each block that contains some of the rows, with the rows in it and which of the given ones they are."""
        if not rows.size:
            return
        number, within = np.divmod(rows, self.size)
        last = int(number.max())
        while len(self.blocks) <= last:
            new = np.zeros if self.fill == 0.0 else np.empty
            self.blocks.append(new((self.size, *self.shape), self.dtype))
            if self.fill != 0.0:
                self.blocks[-1].fill(self.fill)
        if int(number.min()) == last:
            yield self.blocks[last], within, ...
            return
        for k in np.unique(number):
            here = number == k
            yield self.blocks[k], within[here], here
