"""A browser's socket at the lab itself, in the lab's event loop: messages reach it without another socket."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import weakref
from collections.abc import Mapping
from typing import TYPE_CHECKING

from aiohttp import WSCloseCode, WSMsgType, web
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosedOK
from websockets.http11 import Request

from armlab.front.limits import Limits, Meter
from armlab.front.line import PROTOCOL, Ended
from armlab.ui.adapter import NotAMessage

if TYPE_CHECKING:
    from armlab.ui.embedded import Serve

log = logging.getLogger(__name__)

NONSENSE = frozenset(
    {
        WSCloseCode.PROTOCOL_ERROR,
        WSCloseCode.UNSUPPORTED_DATA,
        WSCloseCode.INVALID_TEXT,
        WSCloseCode.POLICY_VIOLATION,
        WSCloseCode.MESSAGE_TOO_BIG,
        WSCloseCode.INTERNAL_ERROR,  # what a lab says to a message that it cannot unpack
    }
)
"""Codes with which a browser is let go for what it has sent."""

CLOSING = 3.0
"""Time, seconds, for a regular close; a browser that no longer reads would delay it for ever."""

GOODBYE = 1.0
"""Longest wait, seconds, for pages to be told that the lab ends."""


class Direct:
    """A browser's connection as viser wants one: it stands in for one of `websockets`.

    Parameters
    ----------
    request : aiohttp.web.BaseRequest
    browser : aiohttp.web.WebSocketResponse
    meter : Meter
    said : mapping
        Headers: what the front says of the browser.

    Attributes
    ----------
    request : websockets.http11.Request
        With the headers.
    subprotocol : str
    code : int
        With which the browser is to be let go.
    """

    def __init__(
        self, request: web.BaseRequest, browser: web.WebSocketResponse, meter: Meter, said: Mapping[str, str]
    ) -> None:
        self._asked, self._browser, self._meter = request, browser, meter
        self.request, self.subprotocol = Request("/", Headers(said)), request.headers[PROTOCOL]
        self.code: int = WSCloseCode.OK

    def has_gone(self) -> bool:
        """Return whether the browser has broken off; what it said before it did is still to be received."""
        return self._asked.transport is None

    async def recv(self) -> bytes:
        """Return the next message.

        Raises
        ------
        ConnectionClosedOK
            The browser has gone, or has to go.
        """
        message = await self._browser.receive()
        if message.type is not WSMsgType.BINARY:
            if message.type is WSMsgType.TEXT:
                self.code = WSCloseCode.UNSUPPORTED_DATA
            raise ConnectionClosedOK(None, None)
        wait = self._meter.take(len(message.data))
        if wait is None:
            self.code = WSCloseCode.POLICY_VIOLATION
            raise ConnectionClosedOK(None, None)
        if wait > 0.0:
            await asyncio.sleep(wait)
        data: bytes = message.data
        return data

    async def send(self, data: bytes) -> None:
        """Send a message; waits until the browser has room, so that viser merges what waits for a slow one.

        Raises
        ------
        ConnectionClosedOK
            The browser has gone.
        """
        try:
            await self._browser.send_bytes(data)
        except ConnectionError:
            raise ConnectionClosedOK(None, None) from None

    async def close(self, code: int = WSCloseCode.OK, reason: str = "") -> None:
        """Let the browser go."""
        self.code = code
        await self._browser.close(code=code, message=reason.encode())


class DirectLine:
    """Leads to a lab in this process; see `armlab.front.line.Line`.

    Parameters
    ----------
    serve : callable
        See `armlab.window.lab.Lab`.
    limits : Limits
    """

    def __init__(self, serve: Serve, limits: Limits) -> None:
        self._serve, self._limits = serve, limits
        self._open: weakref.WeakSet[web.WebSocketResponse] = weakref.WeakSet()

    async def serve(self, request: web.BaseRequest, said: Mapping[str, str], meter: Meter) -> Ended:
        """Serve a socket until it has closed."""
        browser = await self._accepted(request)
        self._open.add(browser)
        connection = Direct(request, browser, meter, said)
        try:
            await self._serve(connection)
        except NotAMessage:
            connection.code = WSCloseCode.INTERNAL_ERROR
        except Exception:
            log.exception("a connection was lost")
            connection.code = WSCloseCode.SERVICE_RESTART
        finally:
            await _let_go(request, browser, connection.code)
        return Ended(browser, connection.code in NONSENSE or browser.close_code in NONSENSE)

    async def _accepted(self, request: web.BaseRequest) -> web.WebSocketResponse:
        browser = web.WebSocketResponse(
            protocols=[request.headers[PROTOCOL]],
            max_msg_size=self._limits.message,
            heartbeat=self._limits.heartbeat,
            compress=False,
        )
        await browser.prepare(request)
        return browser

    async def say_goodbye(self) -> None:
        """Tell the pages that the lab ends."""
        closing = (browser.close(code=WSCloseCode.GOING_AWAY, message=b"restarting") for browser in list(self._open))
        with contextlib.suppress(TimeoutError):  # a page that does not read must not keep the lab from saving
            async with asyncio.timeout(GOODBYE):
                await asyncio.gather(*closing, return_exceptions=True)


async def _let_go(request: web.BaseRequest, browser: web.WebSocketResponse, code: int) -> None:
    """Close a browser's connection."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(CLOSING):
            await browser.close(code=code)
    if request.transport is not None:
        request.transport.abort()
