"""A browser's socket handed over to a lab of a class, which is a process of its own.

The front reads what a browser asks for, and decides who gets in; then the lab has the socket itself, and no message
passes through the front. A file in a folder that only their user may open leads from one process to the other; the
lab's side is `armlab.front.reception`.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
from collections.abc import Mapping

from aiohttp import web

from armlab.front.limits import Meter
from armlab.front.line import PROTOCOL, Ended

ASKED = ("Sec-WebSocket-Key", "Sec-WebSocket-Version", PROTOCOL)
"""Headers of a browser's request by which its socket is opened."""

END = b"\r\n\r\n"
"""End of what a lab gets."""

TAKEN = b"t"
"""Answer of a lab that holds a socket."""

NONSENSE, FINE = b"1", b"0"
"""Answers of a lab when a socket has closed: whether that was for what its browser sent."""


class HandOver:
    """Leads to a lab in another process; see `armlab.front.line.Line`.

    Parameters
    ----------
    address : str
        File of the `Reception` of that lab.
    """

    def __init__(self, address: str) -> None:
        self._address = address

    async def serve(self, request: web.Request, said: Mapping[str, str], _meter: Meter) -> Ended:
        """Hand a socket over, and wait until it has closed. The lab, which reads what its browser sends, counts it."""
        loop, transport = asyncio.get_running_loop(), request.transport
        if transport is None:
            raise ConnectionResetError
        with socket.socket(socket.AF_UNIX) as lab:
            lab.setblocking(False)
            await loop.sock_connect(lab, self._address)
            message = _message(request, said)
            transport.pause_reading()  # what comes now is for the lab
            try:
                sent = socket.send_fds(lab, [message], [transport.get_extra_info("socket").fileno()])
                await loop.sock_sendall(lab, message[sent:])
                if await loop.sock_recv(lab, len(TAKEN)) != TAKEN:
                    raise ConnectionResetError
            except OSError:
                transport.resume_reading()
                raise
            # Both hold the socket now, and the first of two that lets it go closes nothing.
            transport.abort()
            how = FINE
            with contextlib.suppress(OSError):  # a lab that has died says nothing, and its sockets have closed
                how = await loop.sock_recv(lab, len(NONSENSE))
        return Ended(_done(), how == NONSENSE)

    async def say_goodbye(self) -> None:
        """Leave it to the lab, which is told to end by whoever has started it."""


def _done() -> web.Response:
    """Return what aiohttp wants of whoever serves a request, though nobody can be answered any more."""
    return web.Response(status=101)


def _message(request: web.Request, said: Mapping[str, str]) -> bytes:
    """Return what a lab gets with a socket: what the front says, and below it the request to open one."""
    lines = ["GET / HTTP/1.1", "Host: lab", "Connection: Upgrade", "Upgrade: websocket"]
    lines += (f"{name}: {request.headers[name]}" for name in ASKED if name in request.headers)
    return json.dumps(dict(said)).encode() + b"\n" + "\r\n".join(lines).encode("utf-8", "surrogateescape") + END
