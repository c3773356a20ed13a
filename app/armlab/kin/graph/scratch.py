"""Memory to compute in, kept from call to call.

The system takes longer to hand out fresh pages, and to fill them with zeros, than a batch of a thousand configurations
takes to compute. There is nothing in this memory that outlives a call, so that all formulas may use it in turn.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

LARGE = 4 << 20
"""Size in bytes from which NumPy asks the system for large pages, whose addresses are translated faster."""


class Scratch:
    """Blocks of memory nobody computes in now: as many as threads have computed at once, 4 MiB each at most.

    Any thread may take and give back: each is one operation on a list, which no other thread can interrupt.
    """

    def __init__(self) -> None:
        self._free: list[NDArray[np.uint8]] = []

    def take(self, size: int) -> NDArray[np.uint8]:
        """Return so many bytes or more with anything in them, which are the caller's until given back."""
        try:
            block = self._free.pop()
        except IndexError:
            block = np.empty(0, np.uint8)
        # Where large pages pay, one is asked for.
        return block if len(block) >= size else np.empty(max(size, LARGE if size >= LARGE // 4 else 0), np.uint8)

    def give_back(self, block: NDArray[np.uint8]) -> None:
        """Keep a block for who takes one next."""
        self._free.append(block)


KEPT = Scratch()
"""Scratch memory in which all formulas compute."""
