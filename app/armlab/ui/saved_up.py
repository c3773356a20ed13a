"""Time that somebody may take of a thread that serves all: it is saved up, spent, and waited for."""

from __future__ import annotations

import math
import time
from collections.abc import Callable


class SavedUp:
    """Seconds that are saved up at a share of the time that passes, and spent.

    Parameters
    ----------
    share : float
        Seconds that are saved up in a second.
    most : float
        Most that is saved up, seconds: what there is at first.
    longest : float, optional
        Longest time to wait, seconds: a debt that would take longer is forgiven.
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(
        self, share: float, most: float, longest: float = math.inf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._share, self._most, self._longest, self._clock = share, most, longest, clock
        self._left, self._at = most, clock()

    @property
    def wait(self) -> float:
        """Seconds until there is something to spend again, 0 when there is."""
        self._save()
        return max(0.0, -self._left / self._share)

    def spend(self, seconds: float) -> None:
        """Take so much of what has been saved up, though it may be more than that."""
        self._save()
        self._left = max(self._left - seconds, -self._share * self._longest)

    def _save(self) -> None:
        now = self._clock()
        self._left, self._at = min(self._most, self._left + self._share * (now - self._at)), now
