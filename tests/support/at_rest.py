"""Whether the labs of this process have answered all that their pages said, and said all they have to say."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Iterable
from typing import Any, NamedTuple
from weakref import WeakSet

from armlab.front.direct import Direct
from armlab.front.start import Running
from armlab.window.player import Player
from support.patience import WAIT

SOON = 2.0
"""Seconds; what a lab means to do later than this is no part of an answer."""

OPEN: WeakSet[Running] = WeakSet()
"""The labs that were opened in this process."""

ASIDE: WeakSet[asyncio.Future[Any]] = WeakSet()
"""What the labs do in other threads now, for which an answer waits."""


class Traffic(NamedTuple):
    """Messages of all connections that are open now: what the labs have received, and what they have sent.

    A page never counts more as sent than its lab as received, nor the other way round. So where the sums of all pages
    are those of all labs, nothing is on its way between any of them.
    """

    received: int
    sent: int


_receive, _send = Direct.recv, Direct.send


async def _counted_receive(connection: Any, *arguments: Any, **options: Any) -> Any:
    data = await _receive(connection, *arguments, **options)
    connection.count_received = getattr(connection, "count_received", 0) + 1
    return data


async def _counted_send(connection: Any, *arguments: Any, **options: Any) -> None:
    connection.count_sent = getattr(connection, "count_sent", 0) + 1
    await _send(connection, *arguments, **options)


Direct.recv, Direct.send = _counted_receive, _counted_send  # type: ignore[method-assign]

_run_aside = asyncio.BaseEventLoop.run_in_executor


def _counted_aside(loop: Any, *arguments: Any) -> Any:
    future = _run_aside(loop, *arguments)
    ASIDE.add(future)
    future.add_done_callback(ASIDE.discard)
    return future


asyncio.BaseEventLoop.run_in_executor = _counted_aside  # type: ignore[method-assign, assignment]


class Told(NamedTuple):
    """How things stand in the labs of this process.

    Attributes
    ----------
    answered : bool
        Whether every command is applied and shown, and nothing waits to be sent. While a film plays, panels may lag.
    idle : bool
        Whether, besides, no long work is under way, in no thread, and nothing is to happen soon.
    """

    traffic: Traffic
    answered: bool
    idle: bool


def told() -> Told | None:
    """Ask the labs of this process, each on its own event loop; None where there are none."""
    labs = [running.lab for running in OPEN if running.lab is not None]
    found = [_ask(lab) for lab in labs if not lab._stopped.is_set()]
    if not found:
        return None
    traffic = Traffic(sum(each.traffic.received for each in found), sum(each.traffic.sent for each in found))
    return Told(traffic, all(each.answered for each in found), all(each.idle for each in found))


def _ask(lab: Any) -> Told:
    async def look() -> Told:
        server = lab.server._websock_server
        connections = list(server._live_connections.values())
        traffic = Traffic(_sum("count_received", connections), _sum("count_sent", connections))
        buffers = [
            (identifier, buffer)
            for identifier, state in server._client_state_from_id.items()
            for buffer in (state.message_buffer, server.get_message_buffer())
        ]
        soon = _due_soon(lab.loop)
        plays = any(getattr(call, "__func__", None) is Player._next for call in soon)
        done = lab.worker.idle and not lab._due and all(itertools.starmap(_is_sent, buffers))
        making = any(view._making is not None for view in lab._views.values())
        aside = any(each.get_loop() is lab.loop for each in list(ASIDE))
        # A page is built in pieces, and what is shown has its turn after others.
        late = (
            lab.pace.spread._waiting or lab.pace.spread._last or any(map(asyncio.Lock.locked, lab._building.values()))
        )
        idle = done and lab.runner.idle and not (making or aside or soon or late)
        return Told(traffic, done and (plays or not (soon or late)), idle)

    return asyncio.run_coroutine_threadsafe(look(), lab.loop).result(WAIT)


def _sum(count: str, connections: Iterable[Direct]) -> int:
    return sum(getattr(connection, count, 0) for connection in connections)


def _is_sent(identifier: int, buffer: Any) -> bool:
    """Return whether all messages for a client have been taken out of a buffer."""
    return bool(buffer.generator_cursors.get(identifier, -1) == buffer.message_counter - 1)


def _due_soon(loop: Any) -> list[Any]:
    """Return what the lab means to do soon; what only sleeps, or watches over connections, is not in it."""
    asleep = asyncio.futures._set_result_unless_cancelled  # type: ignore[attr-defined]
    timers = (each for each in loop._scheduled if not each.cancelled() and each._callback is not asleep)
    soon = (each._callback for each in timers if each.when() < loop.time() + SOON)
    return [call for call in soon if not str(getattr(call, "__module__", "")).startswith("aiohttp.")]
