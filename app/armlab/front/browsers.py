"""The browsers that have sockets now, or had some within the last minute."""

from __future__ import annotations

import asyncio
from collections import Counter

from armlab.front.limits import Limits, Meter

REMEMBERED = 60.0
"""Time, seconds, for which a browser is known after its last socket, or a flooder would only have to reconnect."""


class Browsers:
    """Browsers by their token: how many sockets each has, and the meter of all of them.

    Parameters
    ----------
    limits : Limits
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._open: Counter[str] = Counter()
        self._meters: dict[str, Meter] = {}
        self._forgetting: dict[str, asyncio.TimerHandle] = {}

    def have_room_for(self, token: str) -> bool:
        """Return whether a browser may open one more socket."""
        return self._open[token] < self._limits.sockets_each and self._open.total() < self._limits.sockets

    def come(self, token: str) -> None:
        """Count one more socket of a browser."""
        self._open[token] += 1
        if (forgetting := self._forgetting.pop(token, None)) is not None:
            forgetting.cancel()

    def go(self, token: str) -> None:
        """Count one less, on a running loop."""
        self._open[token] -= 1
        if self._open[token] <= 0:
            del self._open[token]
            loop = asyncio.get_running_loop()
            self._forgetting[token] = loop.call_later(REMEMBERED, self._forget, token)

    def knows(self, token: str) -> bool:
        """Return whether a browser has been let in before."""
        return token in self._meters

    def meter(self, token: str) -> Meter:
        """Return the meter of a browser that is let in."""
        return self._meters.setdefault(token, Meter(self._limits))

    def _forget(self, token: str) -> None:
        self._forgetting.pop(token, None)
        self._meters.pop(token, None)
