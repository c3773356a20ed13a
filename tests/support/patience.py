"""How long a test waits: in time that its own process could use, so that a machine that stands still costs nothing."""

from __future__ import annotations

import time
from collections.abc import Callable

WAIT = 120.0
"""Seconds to wait for what is certain to come."""

LOOK = 1.0
"""Seconds that may pass between two looks; what a look takes longer, the process was not running."""


class Patience:
    """Time that runs out, counted from look to look.

    Parameters
    ----------
    seconds : float
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, seconds: float = WAIT, clock: Callable[[], float] = time.monotonic) -> None:
        self._left, self._clock = seconds, clock
        self._at = clock()

    def left(self) -> float:
        """Return the seconds that are left, 0 at the end."""
        now = self._clock()
        self._left -= min(now - self._at, LOOK)
        self._at = now
        return max(self._left, 0.0)
