"""Who behaves as the lab's own page does; whoever does not gets little of the lab's time.

The lab's page never sends what the gate drops. A program that does so sends much of it, and would otherwise take as
much time as a class-mate; a page that does so once, for whatever reason, is still served as all others.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

from armlab.session.saved_up import SavedUpEach

DROPPED, DROPPED_AT_ADDRESS = 5.0, 20.0
"""Numbers of dropped messages in a row of a browser, and of all at one address, that change nothing."""

FORGIVEN = 12.0
"""Time in which one more is forgiven, seconds: after a minute without any a browser is as all others."""

DEAR = 20.0
"""Price of time for a browser with bad manners: it gets a twentieth of what others get."""

MOST = 1000
"""Largest number of browsers that are known."""


class Manners:
    """The messages that were dropped, by browser and by the address it comes from.

    Whoever is thrown out comes back as somebody new; so at an address with bad manners a new browser has a minute to
    show that it has good ones.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        rate = 1.0 / FORGIVEN
        self._of_browsers = SavedUpEach(rate, DROPPED, DROPPED / rate, clock)
        self._of_addresses = SavedUpEach(rate, DROPPED_AT_ADDRESS, DROPPED / rate, clock)
        self._known: OrderedDict[str, None] = OrderedDict()

    def meet(self, browser: str, address: str) -> None:
        """Note that a browser, told by its token, has come."""
        is_new = browser not in self._known
        self._known[browser] = None
        self._known.move_to_end(browser)
        if len(self._known) > MOST:
            self._known.popitem(last=False)
        if is_new and self._of_addresses.wait(address) > 0.0:
            self._of_browsers.note(browser, 2.0 * DROPPED)

    def note(self, browser: str, address: str) -> None:
        """Note a message that the lab's page does not send."""
        self._of_browsers.note(browser)
        self._of_addresses.note(address)

    def price(self, browser: str) -> float:
        """Return how many seconds count for each one that the lab works for a browser."""
        return DEAR if self._of_browsers.wait(browser) > 0.0 else 1.0
