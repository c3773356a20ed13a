"""Memory to compute in, kept from call to call.

The system takes longer to hand out fresh pages, and to fill them with zeros, than a batch of a thousand configurations
takes to compute. There is nothing in this memory that outlives a call, so that it may be shared by all formulas.
"""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

LARGE = 4 << 20
"""Bytes from which on NumPy asks the system for large pages, whose addresses are translated faster."""


class Scratch(threading.local):
    """Memory of a thread: as much as its largest call so far has filled, or `LARGE` from a quarter of that on."""

    memory = np.empty(0, np.uint8)

    def rows(self, count: int, length: int, dtype: np.dtype[np.floating]) -> NDArray[np.floating]:
        """Return an array (count, length) with anything in it, the caller's until the same thread asks again."""
        size = count * length * dtype.itemsize
        if size > len(self.memory):
            self.memory = np.empty(max(size, LARGE) if size >= LARGE // 4 else size, np.uint8)
        return self.memory[:size].view(dtype).reshape(count, length)


KEPT = Scratch()
