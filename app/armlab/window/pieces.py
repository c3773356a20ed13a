"""Work on one page in pieces, each of which has its turn among the updates of all pages."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator

from armlab.ui.pace import Pace

PIECE = 0.002
"""Time of a piece after which others have their turn, seconds; a step of the work is not interrupted."""


class Pieces:
    """One piece of work at a time.

    Parameters
    ----------
    pace : Pace
    browser : str
        Token of the one for which the work is done.
    timed : callable
        Calls a function that does a piece, and counts its time.
    done : callable
        Called when work has ended, also by an exception, but not when it was stopped.
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(
        self,
        pace: Pace,
        browser: str,
        timed: Callable[[Callable[[], None]], None],
        done: Callable[[], None],
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        self._pace, self._browser, self._timed, self._done, self._clock = pace, browser, timed, done, clock
        self._work: Generator[None, None, None] | None = None
        self._at_it = self._stopped = False

    @property
    def busy(self) -> bool:
        """Whether there is work that has not ended."""
        return self._work is not None

    def begin(self, work: Generator[None, None, None]) -> None:
        """Do the work, which may be interrupted at each of its steps."""
        self._work = work
        self._pace.put(self._browser, self, self._go_on)

    def stop(self) -> None:
        """Leave the work as it is, for good; it may be that itself which asks for it."""
        self._stopped = True
        self._pace.spread.drop(self)
        if self._work is not None and not self._at_it:
            self._work.close()
            self._work = None

    def _go_on(self) -> None:
        try:
            self._timed(self._piece)
        finally:
            if self._stopped:
                self.stop()
            elif self._work is None:
                self._done()
            else:
                self._pace.put(self._browser, self, self._go_on)

    def _piece(self) -> None:
        assert self._work is not None
        end, self._at_it = self._clock() + PIECE, True
        try:
            for _ in self._work:
                if self._clock() > end:
                    return
        except BaseException:
            self._work = None
            raise
        finally:
            self._at_it = False
        self._work = None
