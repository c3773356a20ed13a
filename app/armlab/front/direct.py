"""The lab in the process of the front, in the same event loop: a browser's messages reach it without another socket."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Mapping
from typing import TYPE_CHECKING

from aiohttp import WSCloseCode, WSMsgType, web
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosedOK
from websockets.http11 import Request

from armlab.front.limits import Meter
from armlab.front.relay import Line, let_go
from armlab.ui.adapter import NotAMessage

if TYPE_CHECKING:
    from armlab.ui.embedded import Serve

log = logging.getLogger(__name__)


class Direct:
    """A browser's connection as viser wants one: it stands in for one of `websockets`.

    Parameters
    ----------
    request : aiohttp.web.Request
    browser : aiohttp.web.WebSocketResponse
    meter : Meter
    protocol : str
    headers : mapping
        What the front says of the browser.

    Attributes
    ----------
    request : websockets.http11.Request
        With the headers.
    subprotocol : str
    code : int
        With which the browser is to be let go.
    """

    def __init__(
        self,
        request: web.Request,
        browser: web.WebSocketResponse,
        meter: Meter,
        protocol: str,
        headers: Mapping[str, str],
    ) -> None:
        self._asked, self._browser, self._meter = request, browser, meter
        self.request, self.subprotocol = Request("/", Headers(headers)), protocol
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


def direct_line(serve: Serve, protocol: str, headers: Mapping[str, str]) -> Line:
    """Return a line to the lab that serves.

    Parameters
    ----------
    serve : callable
        See `armlab.ui.lab.Lab`.
    protocol : str
        Names the version of viser of the page.
    headers : mapping
        What the front says of the browser.
    """

    async def line(request: web.Request, browser: web.WebSocketResponse, meter: Meter) -> bool:
        connection = Direct(request, browser, meter, protocol, headers)
        try:
            await serve(connection)
        except NotAMessage:
            connection.code = WSCloseCode.INTERNAL_ERROR
        except Exception:
            log.exception("a connection was lost")
            connection.code = WSCloseCode.SERVICE_RESTART
        finally:
            was_nonsense = await let_go(request, browser, connection.code)
        return was_nonsense

    return line
