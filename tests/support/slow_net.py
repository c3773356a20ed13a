"""A slow network: a proxy before the lab that holds everything back for a while, both ways, and keeps its order."""

from __future__ import annotations

import asyncio
import random
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from urllib.parse import urlsplit

PIECE = 1 << 16
"""Bytes that are passed on at once."""


@contextmanager
def slowed(url: str, least: float, most: float, seed: int = 0) -> Iterator[str]:
    """Yield the address at which the same lab is reached through a slow network.

    Parameters
    ----------
    url : str
        Of the lab.
    least, most : float
        Seconds by which each piece is late, each way; drawn anew for each, but none overtakes another.
    seed : int
    """
    to = urlsplit(url)
    loop, rng = asyncio.new_event_loop(), random.Random(seed)

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there, onward = await asyncio.open_connection(to.hostname, to.port)
        ways = [asyncio.ensure_future(_late(*way, least, most, rng)) for way in ((reader, onward), (there, writer))]
        try:
            await asyncio.wait(ways, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for way in ways:
                way.cancel()
            for end in (onward, writer):
                end.close()

    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    server = asyncio.run_coroutine_threadsafe(asyncio.start_server(serve, "127.0.0.1", 0), loop).result(10.0)
    try:
        yield f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/"
    finally:
        asyncio.run_coroutine_threadsafe(_end(server), loop).result(10.0)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(10.0)
        loop.close()


async def _late(
    reader: asyncio.StreamReader, writer: asyncio.StreamWriter, least: float, most: float, rng: random.Random
) -> None:
    """Pass on what is read, each piece late by a time of its own."""
    loop, pieces = asyncio.get_running_loop(), asyncio.Queue[tuple[float, bytes]]()

    async def write() -> None:
        while True:
            due, piece = await pieces.get()
            await asyncio.sleep(max(0.0, due - loop.time()))
            if not piece:
                return
            writer.write(piece)
            await writer.drain()

    writing = asyncio.ensure_future(write())
    try:
        with suppress(ConnectionError):
            while piece := await reader.read(PIECE):
                pieces.put_nowait((loop.time() + rng.uniform(least, most), piece))
        pieces.put_nowait((loop.time() + most, b""))
        with suppress(ConnectionError):
            await writing
    finally:
        writing.cancel()


async def _end(server: asyncio.Server) -> None:
    server.close()
    others = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
    for task in others:
        task.cancel()
    await asyncio.gather(*others, return_exceptions=True)
