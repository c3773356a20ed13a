"""The rate of updates that may lag: at once while there is time, less often when a whole class needs the loop.

The arm and its handle are never held back. Panels, overlays and films share a part of the event loop's time; when they
have used it up, they are shown less often, and always once more when things have come to rest.
"""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Callable, Hashable
from typing import Any

from armlab.session.load import Load
from armlab.session.saved_up import SavedUp
from armlab.ui.manners import Manners
from armlab.ui.spread import Spread

PANEL_INTERVAL = 0.125
"""Time between updates of panels, seconds: the scene follows a drag at once, numbers at a pace that can be read."""

NEXT_EVENT = 0.06
"""Time within which the next event of a drag comes, seconds: panels are shown after it, and not beside one."""

SHARE = 0.05
"""Share of the loop's time in which panels, overlays and films of all students may be made; sending costs as much."""

LEAST_SHARE = 0.01
BUSY, FULL = 0.6, 0.95
"""Load of a core from which the share becomes smaller, and load at which the share is least."""

BUILDING = 1.0 / 3.0
"""Share of the loop's time in which pages may be built while others are open, so that a class that opens the lab, or a
stranger who returns again and again, does not stop the arms of the others."""

MEMORY = 1.0
"""Time over which the work is summed, seconds."""

SLOWEST = 1.0
"""Longest time between two pictures, seconds."""

TURNING, TURNING_SAVED_UP, TURNING_WAIT = 0.1, 1.0, 1.0
"""Share of the loop's time in which all browsers together are shown other pages, the most that is saved up, and the
longest wait, seconds. A class may open a page at one time; strangers who come as somebody new again and again get no
more than that."""


class Pace:
    """The time spent on updates that may lag, in one process.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    busy : callable
        How much of a core the whole process uses, 1 for all of it.

    Attributes
    ----------
    spread : Spread
        Through which all that is shown goes.
    turning : SavedUp
        The time for showing other pages, of all browsers together.
    browsers : int
        How many are shown something.
    manners : Manners
        Of the browsers.
    """

    def __init__(self, clock: Callable[[], float] = time.perf_counter, busy: Callable[[], float] | None = None) -> None:
        self._clock, self._busy = clock, busy or Load()
        self.spread, self.browsers, self.manners = Spread(), 0, Manners()
        self.turning = SavedUp(TURNING, TURNING_SAVED_UP, TURNING_WAIT)
        self._spent, self._at = 0.0, clock()

    def put(self, browser: str, key: Hashable, call: Callable[[], None]) -> None:
        """Let a call for a browser, told by its token, have its turn; for one with bad manners after all others."""
        self.spread.put(key, call, last=self.manners.price(browser) > 1.0)

    def rest(self, browser: str, took: float) -> float:
        """Return the seconds for others, after a piece of the page of a browser has taken so many."""
        return took * (self.manners.price(browser) / BUILDING - 1.0)

    def timed(self, call: Callable[..., Any], *arguments: Any) -> Any:
        """Return the result of a call and count its time."""
        began = self._clock()
        try:
            return call(*arguments)
        finally:
            now = self._clock()
            self._spent = self._load(now) * MEMORY + now - began
            self._at = now

    def interval(self, usual: float, browser: str = "") -> float:
        """Return the seconds between two pictures: the usual time while there is time for it, else more.

        Parameters
        ----------
        usual : float
            Seconds.
        browser : str, optional
            Token of the one that is shown them; time is dearer for one with bad manners.
        """
        usual *= self.manners.price(browser)
        load, share = self._load(self._clock()), self._share()
        if load <= share:
            return usual
        return min(max(SLOWEST, usual), max(usual, 0.05) * (load / share) ** 2)

    def _share(self) -> float:
        full = min(max((self._busy() - BUSY) / (FULL - BUSY), 0.0), 1.0)
        return SHARE - full * (SHARE - LEAST_SHARE)

    def _load(self, now: float) -> float:
        """Return the share of the last second or so that was spent."""
        return self._spent * math.exp((self._at - now) / MEMORY) / MEMORY


class Paced:
    """A function of one argument that is called at once when there is time, else later with the newest argument.

    Parameters
    ----------
    call : callable
    pace : Pace
    """

    def __init__(self, call: Callable[[Any], None], pace: Pace) -> None:
        self._call, self._pace = call, pace
        self._newest: Any = None
        self._later: asyncio.TimerHandle | None = None
        self._last = -math.inf

    def __call__(self, argument: Any) -> None:
        """Call now or later."""
        self._newest = argument
        if self._later is not None:
            return
        loop = asyncio.get_running_loop()
        wait = self._last + self._pace.interval(0.0) - loop.time()
        if wait <= 0.0:
            self._come(loop)
        else:
            self._later = loop.call_later(wait, self._come, loop)

    def _come(self, loop: asyncio.AbstractEventLoop) -> None:
        self._later = None
        self._last = loop.time()
        self._pace.spread.put(self, self._run)

    def _run(self) -> None:
        self._pace.timed(self._call, self._newest)

    def stop(self) -> None:
        """Cancel a call that is still to come."""
        self._pace.spread.drop(self)
        if self._later is not None:
            self._later.cancel()
            self._later = None
