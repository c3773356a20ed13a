"""Turns for messages: one browser at a time, and none with more than its share of the event loop."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable

from armlab.session.saved_up import SavedUp

SHARE = 0.05
"""Share of the event loop's time that the messages of one browser may take; a drag takes a hundredth."""

SPARE = 0.2
"""Time that a quiet browser can save up, seconds, for a large file, or a lesson that opens."""

LOOK = 0.25
"""Interval of looking whether the page of a waiting browser has gone, seconds."""


class Turns:
    """The time that the messages of one browser, over all its connections, have taken.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    used : callable
        Seconds of processor time of the calling thread.
    price : callable
        How many seconds count for each one.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        used: Callable[[], float] = time.thread_time,
        price: Callable[[], float] = lambda: 1.0,
    ) -> None:
        self._saved, self._used, self._price = SavedUp(SHARE, SPARE, clock=clock), used, price
        self._began = 0.0
        self._had_one = False

    def begin(self) -> None:
        """Note that the work on a message begins."""
        self._began = self._used()

    def end(self) -> None:
        """Count the time of the message, which was handled without a pause."""
        self._saved.spend((self._used() - self._began) * self._price())

    @property
    def pause(self) -> float:
        """Seconds until the next message may be handled."""
        return self._saved.wait

    async def next(self, receive: Callable[[], Awaitable[bytes]], has_gone: Callable[[], bool]) -> bytes:
        """Return the next message: one each time the event loop runs, also of many sent together.

        Who has gone does not wait any more.
        """
        if self._had_one:
            await asyncio.sleep(0.0)
        while (pause := self.pause) > 0.0 and not has_gone():
            await asyncio.sleep(min(pause, LOOK))
        message = await receive()
        self._had_one = True
        asyncio.get_running_loop().call_soon(self._next_turn)
        return message

    def _next_turn(self) -> None:
        self._had_one = False
