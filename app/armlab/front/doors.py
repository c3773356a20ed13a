"""Connections that are not yet a page's socket: few, for a short time, and with little noise in the log."""

from __future__ import annotations

import asyncio
import logging
import sys
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

from aiohttp import web

from armlab.errors import in_one_line
from armlab.front.limits import Limits

FILES = 4096
"""Number of files and sockets the process may hold open, if its system allows: a class needs about a thousand."""

BACKLOG = 64
"""Length of the queue of connections that wait to be accepted, all of which are accepted before anything else. Much
less than `Limits.visitors`, so that each is heard before as many others have come in."""

SILENCE = 60.0
"""Time, seconds, between two lines of the log on malformed requests, of which a stranger may send any number."""


class Doors:
    """Makes the handler of each connection, and hangs up on those that are slow, or too many.

    Where there are too many, the address with most of them loses its oldest, one that has not asked yet if there is
    any: who asks at once is answered.

    Parameters
    ----------
    limits : Limits
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._waiting: dict[Visitor, asyncio.TimerHandle] = {}  # oldest first
        self._log = logging.getLogger("armlab.front.requests")
        self._log.filters[:] = [Quiet()]

    def __len__(self) -> int:
        """Return the number of connections that are no sockets yet."""
        return len(self._waiting)

    def factory(self, server: web.Server) -> Callable[[], web.RequestHandler]:
        """Return a function that makes the handler of the next connection to a server."""
        loop = asyncio.get_running_loop()
        options = {"keepalive_timeout": self._limits.visit, "auto_decompress": False}
        return lambda: Visitor(self, server, loop=loop, access_log=None, logger=self._log, **options)

    def enter(self, visitor: Visitor) -> None:
        """Register a new connection."""
        loop = asyncio.get_running_loop()
        self._waiting[visitor] = loop.call_later(self._limits.visit, visitor.hang_up)
        if len(self._waiting) > self._limits.visitors:
            crowds = Counter(other.address for other in self._waiting)
            address = max(crowds, key=crowds.__getitem__)
            crowd = [other for other in self._waiting if other.address == address]
            next((other for other in crowd if not other.asked), crowd[0]).hang_up()

    def hear(self, visitor: object) -> None:
        """Note that a connection has sent a request."""
        if isinstance(visitor, Visitor):
            visitor.asked = True

    def leave(self, visitor: object) -> None:
        """Forget a connection that has ended or become a socket; sockets have other limits."""
        if isinstance(visitor, Visitor) and (late := self._waiting.pop(visitor, None)) is not None:
            late.cancel()


class Site(web.BaseSite):
    """An address on which a server listens.

    Parameters
    ----------
    runner : AppRunner
    doors : Doors
        Through which all come in.
    **where
        Host and port, or a socket that is bound already.
    """

    def __init__(self, runner: web.AppRunner, doors: Doors, **where: Any) -> None:
        super().__init__(runner, backlog=BACKLOG)
        self._doors, self._where = doors, where

    @property
    def name(self) -> str:
        """The address, in aiohttp's notation."""
        return str(self._where)

    async def start(self) -> None:
        """Start to listen."""
        await super().start()
        server = self._runner.server
        assert server is not None
        factory = self._doors.factory(server)
        self._server = await asyncio.get_running_loop().create_server(factory, backlog=BACKLOG, **self._where)


class Visitor(web.RequestHandler):
    """One connection."""

    def __init__(self, doors: Doors, server: web.Server, **options: object) -> None:
        super().__init__(server, **options)  # type: ignore[arg-type]
        self._doors = doors
        self.address, self.asked = "", False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Register the connection."""
        super().connection_made(transport)
        self.address = str((transport.get_extra_info("peername") or ("",))[0])
        self._doors.enter(self)

    def connection_lost(self, exc: BaseException | None) -> None:
        """Forget the connection."""
        self._doors.leave(self)
        super().connection_lost(exc)

    def hang_up(self) -> None:
        """End the connection at once, even if the other side no longer reads."""
        self._doors.leave(self)
        if self.transport is not None:
            self.transport.abort()


class Quiet(logging.Filter):
    """A log filter: a traceback becomes one line, and only one such line passes in a while.

    Parameters
    ----------
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._clock, self._until = clock, -float("inf")

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is to be written; a long one is shortened."""
        if record.levelno < logging.WARNING:
            return True
        now = self._clock()
        if now < self._until:
            return False
        self._until = now + SILENCE
        error = record.exc_info[1] if record.exc_info else None
        said = in_one_line(error) if error is not None else record.getMessage()[:160]
        record.msg, record.args, record.exc_info = "a request that makes no sense: %s", (said,), None
        return True


def let_open_many_files() -> None:
    """Raise the number of files this process may hold open, when the system's default is small."""
    if sys.platform == "win32":
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = FILES if hard == resource.RLIM_INFINITY else min(FILES, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
