"""Limits on what one browser may ask of the lab."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from armlab.session.saved_up import SavedUp


@dataclass(frozen=True)
class Limits:
    """Limits of messages and sockets.

    An honest page sends at most 20 messages a second of the handle, 20 of controls and 50 of the camera; these limits
    leave room for all three together. Too fast a sender is slowed down, never cut for it: nothing is lost, the order
    is kept, and TCP makes the browser wait.

    Attributes
    ----------
    message : int
        Bytes of one message.
    rate, burst : float
        Messages a second, and in a burst.
    byte_rate, byte_burst : float
    patience : float
        Seconds of unbroken slowing down by count after which a flooding socket is closed.
    sockets_each, sockets : int
        Largest numbers of sockets of one browser, and of all.
    heartbeat : float
        Seconds between questions whether a page still reads; it is cut off half of that after one it does not answer.
    visitors : int
        Connections that are no sockets yet: asking for the page, receiving it, or silent.
    visit : float
        Seconds after which such a connection ends.
    lapses, lapse_rate : float
        Sockets of one address, in a row and a second, that may be closed for what they sent before its next newcomer
        has to wait: a page costs more than any message.
    newcomers_wait : float
        Longest such wait, seconds; the honest ones behind the same address wait as well.
    requests, request_rate : float
        Requests of one address at a time, enough for a class behind it that opens the lab, and a second: more of them
        are answered later.
    request_wait : float
        Longest time by which one is answered later, seconds.
    """

    message: int = 2 << 20
    rate: float = 120.0
    burst: float = 240.0
    byte_rate: float = 2e6
    byte_burst: float = 8e6
    patience: float = 10.0
    sockets_each: int = 6
    sockets: int = 240
    heartbeat: float = 20.0
    visitors: int = 500
    visit: float = 60.0
    lapses: float = 5.0
    lapse_rate: float = 0.5
    newcomers_wait: float = 4.0
    requests: float = 1000.0
    request_rate: float = 50.0
    request_wait: float = 1.0


class Meter:
    """Count of what one browser sends over all its sockets, so that reconnecting gives no advantage."""

    def __init__(self, limits: Limits, clock: Callable[[], float] = time.monotonic) -> None:
        self._count = SavedUp(limits.rate, limits.burst, clock=clock)
        self._bytes = SavedUp(limits.byte_rate, limits.byte_burst, clock=clock)
        self._patience, self._clock = limits.patience, clock
        self._good = clock()

    def take(self, size: int) -> float | None:
        """Count a message; return the seconds to wait, or None when the sender has flooded too long.

        Only the count can try our patience: an honest upload is slow, not hostile.
        """
        self._count.spend(1.0)
        self._bytes.spend(size)
        wait = self._count.wait
        if wait == 0.0:
            self._good = self._clock()
        elif self._clock() - self._good > self._patience:
            return None
        return max(wait, self._bytes.wait)
