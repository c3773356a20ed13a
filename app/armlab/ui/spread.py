"""Updates spread over turns of the event loop, so that drags are handled between the updates of many others."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Hashable

log = logging.getLogger(__name__)

PIECE = 0.003
"""Time that updates may take in a turn of the loop, seconds: a started one is finished, the others follow after the
messages of all. If those take longer the updates get as much time, so that a class that drags also sees the result."""


class Spread:
    """Calls in the order of their arrival, as many in each turn of the loop as its time allows; see `PIECE`.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock = clock
        self._waiting: dict[Hashable, Callable[[], None]] = {}
        self._left, self._ended = PIECE, 0.0
        self._calling, self._comes_round = False, False

    def put(self, key: Hashable, call: Callable[[], None]) -> None:
        """Call now, if there is time in this turn and no call waits; a newer call with the same key replaces it.

        The loop is the running one. A call that is put from inside another one comes after it.
        """
        is_first = not self._waiting  # nobody's call is done inside what another one is at
        self._waiting[key] = call
        if is_first and not self._calling:
            self._go_on()

    def drop(self, key: Hashable) -> None:
        """Drop the call that waits with this key, if there is one."""
        self._waiting.pop(key, None)

    def _go_on(self) -> None:
        while self._waiting and self._left > 0.0:
            if not self._comes_round:
                self._comes_round = True
                asyncio.get_running_loop().call_soon(self._next_turn)
            self._call_next()

    def _call_next(self) -> None:
        call = self._waiting.pop(next(iter(self._waiting)))
        began, self._calling = self._clock(), True
        try:
            call()
        except Exception:
            # One that fails must stop neither those behind it nor whoever has put it.
            log.exception("something could not be shown")
        finally:
            self._calling, self._ended = False, self._clock()
            self._left -= self._ended - began

    def _next_turn(self) -> None:
        self._comes_round = False
        self._left = max(PIECE, self._clock() - self._ended)
        self._go_on()
