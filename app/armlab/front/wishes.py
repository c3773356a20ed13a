"""Requests in links: their form, and their storage from the loading of a page until its socket opens."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Mapping

from armlab.session.share_text import LONGEST, TEXT

ROUTES = (
    "/robot/{name}",
    "/lesson/{name}",
    "/lesson/{name}/{variant}",
    "/page/{name}",
    "/example/{name}/{example}",
    "/assignment/{name}",
    "/assignment/{name}/{variant}",
    "/erratum/{erratum}",
    "/state/{state}",
)

PAPERS = ("/course", "/course/{name}", "/guide", "/guide/{name}", "/formulas")
"""Addresses of the pages to print, which wish nothing of the lab; the first word is their kind."""

NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,63}\Z")
VARIANT = re.compile(r"[0-9]{1,4}\Z")
ERRATUM = re.compile(r"[0-9A-Za-z]\.[0-9A-Za-z]{1,8}\Z")


_IN_SMALL_LETTERS = frozenset({"kind", "name", "example"})
"""Parts of addresses that have no capitals."""


def route(path: str) -> str:
    """Return the route of one of these addresses whose first word, its ``kind``, may also be typed with capitals.

    >>> route("/robot/{name}")
    '/{kind:(?ai:robot)}/{name}'
    """
    return re.sub(r"\A/([a-z]+)", r"/{kind:(?ai:\1)}", path)


def small(parts: Mapping[str, str]) -> dict[str, str]:
    """Return the parts of a link, in their order, as they are written in addresses: many a title has capitals."""
    return {part: text.lower() if part in _IN_SMALL_LETTERS else text for part, text in parts.items()}


def refused(parts: Mapping[str, str]) -> tuple[int, str] | None:
    """Return status and sentence for a link with invalid parts; None when all are valid."""
    if not NAME.match(parts.get("name", "x")) or not NAME.match(parts.get("example", "x")):
        return 404, "There is no such page."
    if not VARIANT.match(parts.get("variant", "0")):
        return 404, "There is no such page: a variant is a number from 0 to 9999."
    if not ERRATUM.match(parts.get("erratum", "1.1")):
        return 404, "There is no such page: an erratum has an id such as 5.58."
    state = parts.get("state")
    if state is not None and not TEXT.match(state):
        return 400, f"This link is damaged: expected at most {LONGEST} letters, digits, - and _. Copy it again."
    return None


class Wishes:
    """The newest request of each browser, dropped after a while: not everybody who loads a page opens a socket.

    Parameters
    ----------
    most : int
        Largest number of browsers; the oldest request is dropped.
    seconds : float
        Time for which a request is kept, seconds.
    clock : callable
    """

    def __init__(self, most: int = 10_000, seconds: float = 300.0, clock: Callable[[], float] = time.monotonic) -> None:
        self._most, self._seconds, self._clock = most, seconds, clock
        self._waiting: dict[str, tuple[str, float]] = {}  # oldest first

    def __len__(self) -> int:
        return len(self._waiting)

    def put(self, token: str, wish: str) -> None:
        """Store the request of a browser, replacing an earlier one."""
        self._waiting.pop(token, None)
        self._waiting[token] = (wish, self._clock() + self._seconds)
        self._forget()

    def take(self, token: str) -> str | None:
        """Return the request of a browser and forget it."""
        self._forget()
        return self._waiting.pop(token, (None, 0.0))[0]

    def _forget(self) -> None:
        while self._waiting:
            oldest = next(iter(self._waiting))
            if len(self._waiting) <= self._most and self._waiting[oldest][1] > self._clock():
                return
            del self._waiting[oldest]
