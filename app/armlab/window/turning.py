"""The pages that one browser is shown one after the other: at once, but not without end while others use the lab."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Generator

from armlab.session.saved_up import SavedUp
from armlab.ui.pace import Pace
from armlab.window.pieces import Pieces

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
    browser : str
        Token.
    clock : callable
        Seconds that the thread of the loop has computed, so that a busy machine is nobody's fault.
    """

    def __init__(
        self, pace: Pace, show: Callable[[], None], browser: str, clock: Callable[[], float] = time.thread_time
    ) -> None:
        self._pace, self._show, self._browser, self._clock = pace, show, browser, clock
        self._loop = asyncio.get_running_loop()
        self._own, self._of_all = SavedUp(SHARE, SAVED_UP, LONGEST), pace.turning
        self._late: asyncio.TimerHandle | None = None
        self._has_waited = self._again = False
        self._pieces = Pieces(pace, browser, self._timed, self._shown)

    def __call__(self, showing: Callable[[], Generator[None, None, None]], turned: bool) -> None:
        """Show a state: now, or, if another page is wanted, in pieces, and later if there is no time for it.

        Parameters
        ----------
        showing : callable
            Shows the state that there is when it is called, with steps between which others may have their turn.
        turned : bool
            Whether it shows another page, arm or lesson than before.
        """
        if self._late is not None:
            return
        if self._pieces.busy:
            self._again = True
        elif not turned or self._pace.browsers <= 1:
            for _ in showing():
                pass
        elif (wait := self._wait()) > 0.0:
            self._late = self._loop.call_later(wait, self._come)
        else:
            self._has_waited = False
            self._pieces.begin(showing())

    @property
    def busy(self) -> bool:
        """Whether a page is being shown in pieces."""
        return self._pieces.busy

    def _timed(self, show: Callable[[], None]) -> None:
        began = self._clock()
        try:
            show()
        finally:
            took = self._clock() - began
            self._own.spend(took * self._pace.manners.price(self._browser))
            self._of_all.spend(took)

    def _shown(self) -> None:
        """Show what has come while a page was shown in pieces."""
        if self._again:
            self._again = False
            self._show()

    def _wait(self) -> float:
        """Return how long to wait; for the others once, however many they are."""
        return self._own.wait if self._has_waited else max(self._own.wait, self._of_all.wait)

    def _come(self) -> None:
        self._late, self._has_waited = None, True
        self._pace.put(self._browser, self, self._show)

    def stop(self) -> None:
        """Cancel what is still to come."""
        self._pace.spread.drop(self)
        self._pieces.stop()
        if self._late is not None:
            self._late.cancel()
