"""What links ask for, from the loading of a page until its socket opens."""

from __future__ import annotations

import time
from collections.abc import Callable


class Wishes:
    """The newest wish of each browser, forgotten after a while: not everybody who loads a page opens a socket.

    Parameters
    ----------
    most : int
        Of so many browsers; the oldest wish makes room.
    seconds : float
        How long a wish waits.
    clock : callable
    """

    def __init__(self, most: int = 10_000, seconds: float = 300.0, clock: Callable[[], float] = time.monotonic) -> None:
        self._most, self._seconds, self._clock = most, seconds, clock
        self._waiting: dict[str, tuple[str, float]] = {}  # oldest first

    def __len__(self) -> int:
        return len(self._waiting)

    def put(self, token: str, wish: str) -> None:
        """Note the wish of a browser; it replaces an earlier one."""
        self._waiting.pop(token, None)
        self._waiting[token] = (wish, self._clock() + self._seconds)
        self._forget()

    def take(self, token: str) -> str | None:
        """Return the wish of a browser and forget it."""
        self._forget()
        return self._waiting.pop(token, (None, 0.0))[0]

    def _forget(self) -> None:
        while self._waiting:
            oldest = next(iter(self._waiting))
            if len(self._waiting) <= self._most and self._waiting[oldest][1] > self._clock():
                return
            del self._waiting[oldest]
