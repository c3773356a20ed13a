"""Whose message is next: each browser one at a time, and none with more than its share of the event loop."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

SHARE = 0.1
"""Part of the event loop's time that the messages of one browser may take; a hand that drags takes a hundredth."""

SPARE = 0.2
"""Seconds of that time which a browser that was quiet has saved up: for a large file, or a lesson that opens."""


class Turns:
    """What the messages of one browser, over all its connections, have taken.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    used : callable
        Seconds of processor time of the calling thread.
    """

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, used: Callable[[], float] = time.thread_time
    ) -> None:
        self._clock, self._used = clock, used
        self._saved, self._at, self._began = SPARE, clock(), 0.0

    def begin(self) -> None:
        """Note that a message is looked at."""
        self._began = self._used()

    def end(self) -> None:
        """Count the time of the message; it was looked at without a pause."""
        self._refill()
        self._saved -= self._used() - self._began

    @property
    def pause(self) -> float:
        """Seconds until the next message may be looked at."""
        self._refill()
        return max(0.0, -self._saved / SHARE)

    def _refill(self) -> None:
        now = self._clock()
        self._saved = min(SPARE, self._saved + (now - self._at) * SHARE)
        self._at = now

    async def come(self) -> None:
        """Wait for the next turn: one each time the loop goes round, also for many messages sent together."""
        await asyncio.sleep(self.pause)
