"""Lines from the front to the labs, which serve the sockets of browsers until they have closed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from aiohttp import web

from armlab.front.limits import Meter

PROTOCOL = "Sec-WebSocket-Protocol"
"""Header of a request that names the version of viser of the page."""


class Ended(NamedTuple):
    """How a socket has ended.

    Attributes
    ----------
    response : aiohttp.web.StreamResponse
        For aiohttp, which wants one of whoever serves a request.
    was_nonsense : bool
        Whether its browser was let go for what it sent.
    """

    response: web.StreamResponse
    was_nonsense: bool


class Line(Protocol):
    """Leads to a lab."""

    async def serve(self, request: web.Request, said: Mapping[str, str], meter: Meter) -> Ended:
        """Serve a socket until it has closed.

        Parameters
        ----------
        request : aiohttp.web.Request
            Not answered yet.
        said : mapping
            Headers: what the front says of the browser.
        meter : Meter

        Raises
        ------
        OSError
            The lab is not there; the request is still to be answered.
        """

    async def say_goodbye(self) -> None:
        """Tell the pages that the lab ends, if the lab does not do so itself."""
