"""The use of a processor core by this process, for work that gives way to people dragging the arm."""

from __future__ import annotations

import time
from collections.abc import Callable

WINDOW = 0.5
"""Window of the average, seconds."""


class Load:
    """The use of processor time, as a part of one core, over the last half second or so.

    Parameters
    ----------
    used : callable
        Seconds of processor time so far; those of the whole process when left out.
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(
        self, used: Callable[[], float] = time.process_time, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._used, self._clock = used, clock
        self._mark = clock(), used()
        self._load = 0.0

    def __call__(self) -> float:
        """Return the use, 1 for a whole core."""
        now = self._clock()
        passed = now - self._mark[0]
        if passed >= WINDOW:
            used = self._used()
            self._load = (used - self._mark[1]) / passed
            self._mark = now, used
        return self._load


def of_others() -> float:
    """Return the processor time of this process, seconds, without that of the calling thread."""
    return time.process_time() - time.thread_time()
