"""Who has been served least: turns in one thread for many, so that nobody waits for those who ask for much."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

Key = TypeVar("Key", bound=Hashable)

MEMORY = 2.0
"""Time over which is summed, seconds."""

ALIKE = 0.1
"""Difference of two, seconds, from which one comes first; otherwise it is whoever has waited longer. A hand that drags
takes less."""

MOST = 500
"""Largest number of those of whom something is known; of those beyond it that have taken least nothing is."""


class Served:
    """The time that each of many has taken lately.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._taken: dict[Hashable, tuple[float, float]] = {}

    def add(self, key: Hashable, seconds: float) -> None:
        """Count the time that one has taken."""
        now = self._clock()
        self._taken[key] = self._of(key, now) + seconds, now
        if len(self._taken) > MOST:
            most = sorted(self._taken, key=lambda each: self._of(each, now))[MOST // 2 :]
            self._taken = {each: self._taken[each] for each in most}

    def least(self, keys: Iterable[Key]) -> Key:
        """Return the one that has taken least, the first of several."""
        now = self._clock()
        return min(keys, key=lambda each: math.floor(self._of(each, now) / ALIKE))

    def is_modest(self, key: Hashable) -> bool:
        """Return whether one has taken no more than a hand that drags."""
        return self._of(key, self._clock()) < ALIKE

    def _of(self, key: Hashable, now: float) -> float:
        taken, at = self._taken.get(key, (0.0, now))
        return taken * math.exp((at - now) / MEMORY)
