"""A WebSocket passed through to a lab and back, slowed down to the limits, with back-pressure from end to end."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Awaitable, Callable, Coroutine

from aiohttp import ClientError, ClientWebSocketResponse, WSCloseCode, WSMsgType, web

from armlab.front.limits import Meter

log = logging.getLogger(__name__)

Line = Callable[[web.Request, web.WebSocketResponse, Meter], Awaitable[bool]]
"""Passes messages between a browser and its lab until one side closes; returns whether that was for nonsense."""

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

UNSAID = (1005, 1006, 1015)
"""Codes with which an end of a connection notes that the other one has said none."""

CLOSING = 3.0
"""Time, seconds, for a regular close; a browser that no longer reads would delay it for ever."""


async def relay(
    lab: ClientWebSocketResponse, request: web.Request, browser: web.WebSocketResponse, meter: Meter
) -> bool:
    """Pass messages both ways until one side closes, then close the other one; return whether that was for nonsense."""
    pumps = [asyncio.create_task(_to_lab(browser, lab, meter)), asyncio.create_task(_to_browser(lab, browser))]
    try:
        await asyncio.wait(pumps, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for pump in pumps:
            pump.cancel()
        ends = await asyncio.gather(*pumps, return_exceptions=True)
        for end in ends:
            # That a connection breaks is no news; anything else is a fault of the front.
            if isinstance(end, Exception) and not isinstance(end, (ClientError, ConnectionError)):
                log.error("a connection was lost", exc_info=end)
        code = next((end for end in ends if isinstance(end, int)), None) or _told(lab.close_code)
        was_nonsense = await let_go(request, browser, code, lab.close())
    return was_nonsense


async def let_go(
    request: web.Request, browser: web.WebSocketResponse, code: int, *also: Coroutine[None, None, object]
) -> bool:
    """Close a browser's connection, and wait for what else is to be done; return whether it was for nonsense."""
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(asyncio.gather(browser.close(code=code), *also, return_exceptions=True), CLOSING)
    if request.transport is not None:
        request.transport.abort()
    return code in NONSENSE or browser.close_code in NONSENSE


def _told(code: int | None) -> int:
    """Return the code with which a browser is told how its lab ended.

    A lab that ended without a word leaves a code that must not be sent: a browser would take it for a fault of the
    protocol. The lab is started again, and the browser comes back by itself.
    """
    return WSCloseCode.SERVICE_RESTART if code is None or code in UNSAID else code


async def _to_lab(browser: web.WebSocketResponse, lab: ClientWebSocketResponse, meter: Meter) -> int | None:
    """Pass on what the browser sends; return a close code when it exceeds the limits."""
    async for message in browser:
        if message.type is not WSMsgType.BINARY:
            return WSCloseCode.UNSUPPORTED_DATA
        wait = meter.take(len(message.data))
        if wait is None:
            return WSCloseCode.POLICY_VIOLATION
        if wait > 0.0:
            await asyncio.sleep(wait)
        await lab.send_bytes(message.data)
    return None


async def _to_browser(lab: ClientWebSocketResponse, browser: web.WebSocketResponse) -> None:
    # Sending waits until the browser has room: a slow one slows its lab connection, and viser merges what waits there.
    async for message in lab:
        if message.type is WSMsgType.BINARY:
            await browser.send_bytes(message.data)
