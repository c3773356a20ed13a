"""The place at which a lab that is a process of its own receives the sockets that the front hands over."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import os
import socket
from collections.abc import Coroutine
from functools import partial
from pathlib import Path
from typing import cast

from aiohttp import web

from armlab.errors import in_one_line
from armlab.front.browsers import Browsers
from armlab.front.direct import DirectLine
from armlab.front.doors import Quiet
from armlab.front.handover import END, FINE, NONSENSE, TAKEN
from armlab.front.limits import Limits

log = logging.getLogger(__name__)

AGAIN = 1.0
"""Time, seconds, after which sockets are received again where that has failed."""

TOGETHER = 65536
"""Number of bytes that are received together."""


class Reception:
    """Receives browsers' sockets in the process of a lab.

    Parameters
    ----------
    address : str
        A file that is not there, or was left behind, in a folder of this user alone.
    line : DirectLine
    limits : Limits
    """

    def __init__(self, address: str, line: DirectLine, limits: Limits) -> None:
        self._address, self._line, self._limits = address, line, limits
        self._browsers = Browsers(limits)
        self._log = logging.getLogger("armlab.front.received")
        self._log.filters[:] = [Quiet()]
        self._tasks: set[asyncio.Task[None]] = set()

    async def open(self) -> None:
        """Begin to receive, on the loop of the lab."""
        Path(self._address).unlink(missing_ok=True)
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(self._address)
        listener.listen(self._limits.sockets)
        listener.setblocking(False)
        self._keep(self._receive_all(listener))

    async def _receive_all(self, listener: socket.socket) -> None:
        with listener:
            while True:
                try:
                    front, _ = await asyncio.get_running_loop().sock_accept(listener)
                except OSError as error:  # such as too many open files, which will be fewer
                    log.error("no socket can be received: %s", in_one_line(error))
                    await asyncio.sleep(AGAIN)
                else:
                    self._keep(self._receive(front))

    def _keep(self, work: Coroutine[None, None, None]) -> None:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _receive(self, front: socket.socket) -> None:
        """Serve one socket, and tell the front how it has ended."""
        loop = asyncio.get_running_loop()
        with front, contextlib.suppress(OSError):  # the front has ended
            said, head, browser = await _received(front)
            await loop.sock_sendall(front, TAKEN)
            ended: asyncio.Future[bytes] = loop.create_future()
            server = web.Server(partial(self._serve, said, ended))
            made = partial(_Received, server, ended, loop, self._log)
            _, handler = await loop.connect_accepted_socket(made, browser)
            handler.data_received(head)
            await loop.sock_sendall(front, await ended)

    async def _serve(
        self, said: dict[str, str], ended: asyncio.Future[bytes], request: web.BaseRequest
    ) -> web.StreamResponse:
        """Serve the first request of a connection; what the front says of a browser is nothing that it has sent."""
        cast("_Received", request.protocol).is_served = True
        token, how = said["X-Armlab-Token"], FINE
        self._browsers.come(token)
        try:
            end = await self._line.serve(request, said, self._browsers.meter(token))
            how = NONSENSE if end.was_nonsense else FINE
        except web.HTTPException as refusal:
            refusal.force_close()  # nothing else is served here
            raise
        except ConnectionError:  # the browser has gone before it was answered
            return web.Response()
        finally:
            self._browsers.go(token)
            _tell(ended, how)
        return end.response


class _Received(web.RequestHandler):
    """The connection of a socket that was handed over; it may break before it is served.

    Parameters
    ----------
    server : aiohttp.web.Server
    ended : asyncio.Future
        Told then.
    loop : asyncio.AbstractEventLoop
    logger : logging.Logger
        For requests that make no sense.
    """

    def __init__(
        self,
        server: web.Server,
        ended: asyncio.Future[bytes],
        loop: asyncio.AbstractEventLoop,
        logger: logging.Logger,
    ) -> None:
        super().__init__(server, loop=loop, access_log=None, logger=logger)  # type: ignore[arg-type]
        self._ended, self.is_served = ended, False

    def connection_lost(self, exc: BaseException | None) -> None:
        """Note the end of the connection."""
        super().connection_lost(exc)
        if not self.is_served:
            _tell(self._ended, FINE)


def _tell(ended: asyncio.Future[bytes], how: bytes) -> None:
    if not ended.done():
        ended.set_result(how)


async def _received(front: socket.socket) -> tuple[dict[str, str], bytes, socket.socket]:
    """Return what the front says of a browser, the request to be served, and the browser's socket.

    Raises
    ------
    OSError
        The front has ended in the middle of it.
    """
    loop = asyncio.get_running_loop()
    front.setblocking(False)
    await _something_has_come(front)
    data, files, _, _ = socket.recv_fds(front, TOGETHER, 1)
    if not files:
        raise ConnectionResetError
    try:
        browser = socket.socket(fileno=files[0])
    except OSError:
        os.close(files[0])
        raise
    while not data.endswith(END):
        more = await loop.sock_recv(front, TOGETHER)
        if not more:
            browser.close()
            raise ConnectionResetError
        data += more
    said, head = data.split(b"\n", 1)
    return json.loads(said), head, browser


async def _something_has_come(front: socket.socket) -> None:
    loop, there = asyncio.get_running_loop(), asyncio.Event()
    loop.add_reader(front, there.set)
    try:
        await there.wait()
    finally:
        loop.remove_reader(front)
