"""The pages that one browser is shown one after the other: at once, but not without end while others use the lab."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable

from armlab.session.saved_up import SavedUp
from armlab.ui.pace import Pace

SHARE, SAVED_UP = 0.01, 0.5
"""Share of the loop's time in which one browser is shown other pages, and the most that it saves up, seconds. A page
takes some 10 ms: a person may open forty in a row and then one a second; who presses faster than that waits."""

LONGEST = 1.0
"""Longest time that one waits for the next page, seconds, however much the last ones took."""


class Turning:
    """The time spent on showing other pages to one browser; the more it has taken, the longer it waits.

    Parameters
    ----------
    pace : Pace
    show : callable
        Called when the time for what had to wait has come; it calls the object again.
    clock : callable
        Seconds that the thread of the loop has computed, so that a busy machine is nobody's fault.
    """

    def __init__(self, pace: Pace, show: Callable[[], None], clock: Callable[[], float] = time.thread_time) -> None:
        self._pace, self._show, self._clock = pace, show, clock
        self._loop = asyncio.get_running_loop()
        self._own, self._of_all = SavedUp(SHARE, SAVED_UP, LONGEST), pace.turning
        self._late: asyncio.TimerHandle | None = None
        self._has_waited = False

    def __call__(self, show: Callable[[], None], turned: bool) -> None:
        """Show a state now, or later if another page is wanted and there is no time for it.

        Parameters
        ----------
        show : callable
        turned : bool
            Whether it shows another page, arm or lesson than before.
        """
        if self._late is not None:
            return
        if not turned or self._pace.browsers <= 1:
            show()
        elif (wait := self._wait()) > 0.0:
            self._late = self._loop.call_later(wait, self._come)
        else:
            self._has_waited = False
            self.timed(show)

    def timed(self, show: Callable[[], None]) -> None:
        """Show something now that belongs to another page, and count its time where there are others."""
        began = self._clock()
        try:
            show()
        finally:
            if self._pace.browsers > 1:
                took = self._clock() - began
                self._own.spend(took)
                self._of_all.spend(took)

    def _wait(self) -> float:
        """Return how long to wait; for the others once, however many they are."""
        return self._own.wait if self._has_waited else max(self._own.wait, self._of_all.wait)

    def _come(self) -> None:
        self._late, self._has_waited = None, True
        self._pace.spread.put(self, self._show)

    def stop(self) -> None:
        """Cancel what is still to come."""
        self._pace.spread.drop(self)
        if self._late is not None:
            self._late.cancel()
