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


STARVING = 1.0
"""Time, seconds, after which one of those that come last is called though others wait."""


class Spread:
    """Calls in the order of their arrival, as many in each turn of the loop as its time allows; see `PIECE`.

    Besides, there are those that come last: one in each turn, when none of the others waits, or after `STARVING`.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock = clock
        self._waiting: dict[Hashable, Callable[[], None]] = {}
        self._last: dict[Hashable, Callable[[], None]] = {}
        self._left, self._ended, self._last_at = PIECE, 0.0, 0.0
        self._calling, self._comes_round, self._had_last = False, False, False

    def put(self, key: Hashable, call: Callable[[], None], last: bool = False) -> None:
        """Call now, if there is time in this turn and no call waits; a newer call with the same key replaces it.

        The loop is the running one. A call that is put from inside another one comes after it.

        Parameters
        ----------
        key : hashable
        call : callable
        last : bool
            Whether it comes after all others, also those that are put later.
        """
        calls, others = (self._last, self._waiting) if last else (self._waiting, self._last)
        others.pop(key, None)
        # Nobody's call is done inside what another one is at.
        is_first = not (self._waiting or (last and self._last))
        if last and not self._last:
            self._last_at = self._clock()
        calls[key] = call
        if is_first and not self._calling:
            self._go_on(with_last=last)
        self._come_round()

    def drop(self, key: Hashable) -> None:
        """Drop the call that waits with this key, if there is one."""
        self._waiting.pop(key, None)
        self._last.pop(key, None)

    def _go_on(self, with_last: bool) -> None:
        while self._waiting and self._left > 0.0:
            began = self._clock()
            self._call_next(self._waiting)
            self._left -= self._ended - began
        if with_last and self._last and not self._had_last and (self._is_starving() or self._has_time()):
            self._had_last = True
            self._call_next(self._last)
            self._last_at = self._ended

    def _has_time(self) -> bool:
        return self._left > 0.0 and not self._waiting

    def _is_starving(self) -> bool:
        """Return whether one that comes last has waited for long."""
        return self._clock() - self._last_at > STARVING

    def _come_round(self) -> None:
        if not self._comes_round:
            self._comes_round = True
            asyncio.get_running_loop().call_soon(self._next_turn)

    def _call_next(self, calls: dict[Hashable, Callable[[], None]]) -> None:
        call = calls.pop(next(iter(calls)))
        self._calling = True
        try:
            call()
        except Exception:
            # One that fails must stop neither those behind it nor whoever has put it.
            log.exception("something could not be shown")
        finally:
            self._calling, self._ended = False, self._clock()

    def _next_turn(self) -> None:
        self._comes_round = self._had_last = False
        self._left = max(PIECE, self._clock() - self._ended)
        self._go_on(with_last=True)
        if self._waiting or self._last:
            self._come_round()
