"""Who behaves as the lab's own page does; whoever does not gets little of the lab's time.

No page of the lab sends what the gate calls nonsense. A program that does so sends much of it, and would otherwise take
as much time as a classmate; a page that does so once, for whatever reason, is still served as all others.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

from armlab.session.saved_up import SavedUpEach

SENSELESS, SENSELESS_AT_ADDRESS = 5.0, 20.0
"""Numbers of senseless messages in a row of a browser, and of all at one address, that change nothing."""

FORGIVEN = 12.0
"""Time in which one more is forgiven, seconds: after a minute without any a browser is as all others."""

DEAR = 20.0
"""Price of time for a browser with bad manners: it gets a twentieth of what others get."""

MOST = 10_000
"""Largest number of browsers that are known."""


class Manners:
    """The senseless messages, by browser and by the address it comes from.

    Whoever is thrown out comes back as somebody new. So at an address with bad manners a new browser is taken for one
    of those until a first senseless message would have been forgiven, which is about as long as its page is built.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        rate = 1.0 / FORGIVEN
        self._of_browsers = SavedUpEach(rate, SENSELESS, SENSELESS / rate, clock)
        self._of_addresses = SavedUpEach(rate, SENSELESS_AT_ADDRESS, SENSELESS / rate, clock)
        self._known: OrderedDict[str, None] = OrderedDict()

    def meet(self, browser: str, address: str) -> None:
        """Note that a browser, told by its token, has come."""
        is_new = browser not in self._known
        self._known[browser] = None
        self._known.move_to_end(browser)
        if len(self._known) > MOST:
            self._known.popitem(last=False)
        if is_new and self._of_addresses.wait(address) > 0.0:
            self._of_browsers.note(browser, SENSELESS + 1.0)

    def note(self, browser: str, address: str) -> None:
        """Note a senseless message."""
        self._of_browsers.note(browser)
        self._of_addresses.note(address)

    def price(self, browser: str) -> float:
        """Return how many seconds count for each one that the lab works for a browser."""
        return DEAR if self._of_browsers.wait(browser) > 0.0 else 1.0
