"""Wrong keys of a teacher's desk: who has tried too many has to wait, and nobody waits for the tries of others."""

from __future__ import annotations

from collections.abc import Callable

TRIES = 5
"""Number of wrong keys with which a browser, and the address that it comes from, have used up their own tries."""

FORGOTTEN = 3600.0
"""Time without a wrong key after which a browser or an address has its own tries again, seconds."""

TOGETHER = (200.0, 50.0, 1.0)
"""Largest numbers of wrong keys in a row: of all who have tries of their own, of those of whom either the browser or
the address has none left, such as new browsers at one address, and of the others. Each group is a bound of its own, so
that it cannot use up what another one may try."""

PAUSE = 5.0
"""Time after which a group that is at its bound may try one more, seconds."""

MOST = 5000
"""Number of browsers and addresses that are remembered, more than all groups let try within the hour; the one with the
oldest wrong key is forgotten first."""


class Guesses:
    """The wrong keys that were tried at one desk.

    Parameters
    ----------
    clock : callable
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._wrong: dict[tuple[str, str], tuple[int, float]] = {}
        self._together = [(0.0, clock())] * len(TOGETHER)

    def must_wait(self, browser: str, address: str) -> bool:
        """Return whether no key is looked at now that comes from this browser at this address."""
        group = self._group(browser, address)
        return self._level(group) > TOGETHER[group] - 1.0

    def note(self, browser: str, address: str) -> None:
        """Count a wrong key."""
        group, now = self._group(browser, address), self._clock()
        self._together[group] = self._level(group) + 1.0, now
        for who in _both(browser, address):
            count = self._count(who) + 1
            self._wrong.pop(who, None)  # the newest stand last
            self._wrong[who] = count, now
        while len(self._wrong) > MOST:
            del self._wrong[next(iter(self._wrong))]

    def _group(self, browser: str, address: str) -> int:
        return sum(self._count(who) >= TRIES for who in _both(browser, address))

    def _count(self, who: tuple[str, str]) -> int:
        count, at = self._wrong.get(who, (0, 0.0))
        return count if self._clock() - at < FORGOTTEN else 0

    def _level(self, group: int) -> float:
        """Return the wrong keys of a group that still count: one less after each `PAUSE`."""
        level, at = self._together[group]
        return max(0.0, level - (self._clock() - at) / PAUSE)


def _both(browser: str, address: str) -> tuple[tuple[str, str], ...]:
    return ("browser", browser), ("address", address)
