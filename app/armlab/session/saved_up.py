"""A token bucket: an amount, such as seconds of computing, that is saved up as time passes, and spent."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from functools import partial


class SavedUp:
    """A token bucket, which may be overdrawn: then it tells how long to wait.

    Parameters
    ----------
    rate : float
        How much is saved up in a second.
    most : float
        The most that is saved up, and what there is at first.
    longest : float, optional
        Longest time to wait, seconds: a debt that would take longer is forgiven.
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(
        self, rate: float, most: float, longest: float = math.inf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._rate, self._most, self._longest, self._clock = rate, most, longest, clock
        self._left, self._at = most, clock()

    @property
    def wait(self) -> float:
        """Seconds until there is something to spend again, 0 when there is."""
        self._save()
        return max(0.0, -self._left / self._rate)

    def spend(self, amount: float) -> None:
        """Take so much of what has been saved up, though it may be more than that."""
        self._save()
        self._left = max(self._left - amount, -self._rate * self._longest)

    def _save(self) -> None:
        now = self._clock()
        self._left, self._at = min(self._most, self._left + self._rate * (now - self._at)), now


class SavedUpEach:
    """A token bucket for each of many, such as addresses.

    Parameters
    ----------
    rate, most, longest : float
    clock : callable
        See `SavedUp`.
    """

    MOST = 1000
    """Number of those that are counted; the one that was noted longest ago is forgotten first."""

    def __init__(
        self, rate: float, most: float, longest: float = math.inf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._new = partial(SavedUp, rate, most, longest, clock)
        self._left: dict[str, SavedUp] = {}

    def note(self, key: str, amount: float = 1.0) -> None:
        """Take so much of what one has saved up."""
        found = self._left.pop(key, None) or self._new()
        self._left[key] = found
        while len(self._left) > self.MOST:
            del self._left[next(iter(self._left))]
        found.spend(amount)

    def wait(self, key: str) -> float:
        """Return the time that one has to wait, seconds."""
        return self._left[key].wait if key in self._left else 0.0
