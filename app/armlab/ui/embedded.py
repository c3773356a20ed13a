"""viser in an event loop that runs already: no loop of its own, and no port.

viser opens both in a thread, and keeps the function that serves a connection to itself. Here that thread is given a
loop that passes all on to the running one, and what would listen at a port only takes that function.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable, Coroutine, Iterator
from concurrent.futures import CancelledError
from types import SimpleNamespace
from typing import Any

from viser.infra import _infra

Serve = Callable[[Any], Awaitable[None]]
"""Serves a connection, which stands in for one of `websockets`, until it has closed."""


class _Running:
    """An event loop that runs in another thread, as if it had been made for the thread that starts it."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop

    def __getattr__(self, name: str) -> Any:
        return getattr(self._loop, name)

    def run_until_complete(self, work: Coroutine[Any, Any, Any]) -> None:
        with contextlib.suppress(CancelledError):  # whoever ends the loop ends what runs in it
            asyncio.run_coroutine_threadsafe(work, self._loop).result()

    def stop(self) -> None:
        """Go on: others need the loop."""

    close = stop


class _Asyncio:
    """The module, for a thread that thinks that it makes a loop."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop

    def __getattr__(self, name: str) -> Any:
        return getattr(asyncio, name)

    def new_event_loop(self) -> _Running:
        return _Running(self._loop)

    def set_event_loop(self, loop: object) -> None:
        """Leave the thread without one."""


@contextlib.contextmanager
def embedded(loop: asyncio.AbstractEventLoop) -> Iterator[list[Serve]]:
    """Let the viser server that is made meanwhile run in a loop; its function that serves is put into the list.

    No other one may be made at the same time.
    """
    taken: list[Serve] = []

    @contextlib.asynccontextmanager
    async def serve(handler: Serve, *_: object, **__: object) -> Any:
        taken.append(handler)
        yield SimpleNamespace(server=SimpleNamespace(sockets=()))

    changed: Any = _infra
    listening = changed.websockets.asyncio.server
    usual = listening.serve
    changed.asyncio, listening.serve = _Asyncio(loop), serve
    try:
        yield taken
    finally:
        changed.asyncio, listening.serve = asyncio, usual
