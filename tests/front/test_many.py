"""As many sockets as the limits allow pass through the front at a time."""

import asyncio
import contextlib
import tempfile
from contextlib import AsyncExitStack, asynccontextmanager
from types import SimpleNamespace

import aiohttp
import pytest
from aiohttp import WSCloseCode, web
from websockets.exceptions import ConnectionClosedOK

from armlab.front.direct import DirectLine
from armlab.front.front import Front
from armlab.front.handover import HandOver
from armlab.front.limits import Limits
from armlab.front.page import make_page
from armlab.front.reception import Reception
from armlab.front.tokens import Tokens
from armlab.ui.adapter import NotAMessage
from support.patience import WAIT
from support.student import run

PROTOCOL = "viser-v1.1.1"


@asynccontextmanager
async def served(app):
    """Serve an application on a free port, which is given, and let no socket delay its end."""
    runner = web.AppRunner(app, shutdown_timeout=0.1)
    await runner.setup()
    try:
        site = web.TCPSite(runner, "127.0.0.1", 0)
        await site.start()
        yield runner.addresses[0][1]
    finally:
        await runner.cleanup()


async def echo(connection):
    """Send back what comes, as a lab that has nothing else to do."""
    with contextlib.suppress(ConnectionClosedOK):
        while True:
            await connection.send(await connection.recv())


@contextlib.asynccontextmanager
async def straight(serve, limits):
    """A line to a lab of this process."""
    yield DirectLine(serve, limits)


@contextlib.asynccontextmanager
async def handed_over(serve, limits):
    """A line to a lab as if it were another process."""
    with tempfile.TemporaryDirectory() as folder:
        await Reception(f"{folder}/lab", DirectLine(serve, limits), limits).open()
        yield HandOver(f"{folder}/lab")


WAYS = pytest.mark.parametrize("way", [straight, handed_over])


def test_who_asks_too_often_is_answered_later():
    async def main():
        limits = Limits(requests=3.0, request_rate=1e-6, request_wait=0.3)
        front = Front(make_page(), Tokens(b"s" * 32), None, limits)
        loop = asyncio.get_running_loop()
        async with served(front.app) as port, aiohttp.ClientSession() as session:
            took = []
            for path in ("", "nothing", "", "", "nothing"):
                began = loop.time()
                async with session.get(f"http://127.0.0.1:{port}/{path}") as answer:
                    assert answer.status == (404 if path else 200)
                took.append(loop.time() - began)
        assert min(took[3:]) >= 0.3

    run(main())


@WAYS
def test_who_opens_sockets_too_often_waits_as_well(way):
    async def main():
        tokens, limits = Tokens(b"s" * 32), Limits(requests=3.0, request_rate=1e-6, request_wait=0.3)
        async with AsyncExitStack() as opened:
            front = Front(SimpleNamespace(), tokens, None, limits)
            front.open_labs([await opened.enter_async_context(way(echo, limits))])
            url = f"http://127.0.0.1:{await opened.enter_async_context(served(front.app))}"
            browser = await opened.enter_async_context(aiohttp.ClientSession(headers={"Origin": url}))
            cookie = {"Cookie": f"{tokens.cookie}={tokens.new()}"}
            took = []
            for _ in range(5):
                began = asyncio.get_running_loop().time()
                await browser.ws_connect(url, protocols=[PROTOCOL], headers=cookie)
                took.append(asyncio.get_running_loop().time() - began)
        assert min(took[3:]) >= 0.3

    run(main())


async def offended(connection):
    """Fail as a lab does that was sent what it cannot unpack."""
    with contextlib.suppress(ConnectionClosedOK):
        if await connection.recv() == b"nonsense":
            raise NotAMessage
        await connection.close(WSCloseCode.GOING_AWAY)


async def open_again(said, way):
    """Return whether a browser is let in again, and a newcomer, after the lab has closed for what the first one said.

    A newcomer who has to wait would wait for days.
    """
    tokens, limits = Tokens(b"s" * 32), Limits(lapses=0.0, lapse_rate=1e-6, newcomers_wait=1e6)
    async with AsyncExitStack() as opened:
        front = Front(SimpleNamespace(), tokens, None, limits)
        front.open_labs([await opened.enter_async_context(way(offended, limits))])
        url = f"http://127.0.0.1:{await opened.enter_async_context(served(front.app))}"
        browser = await opened.enter_async_context(aiohttp.ClientSession(headers={"Origin": url}))
        values = [tokens.new() for _ in range(2)]

        async def is_let_in(value, patience):
            cookie = {"Cookie": f"{tokens.cookie}={value}"}
            try:
                async with asyncio.timeout(patience):
                    return await browser.ws_connect(url, protocols=[PROTOCOL], headers=cookie)
            except TimeoutError:
                return None

        first = await is_let_in(values[0], WAIT)
        await first.send_bytes(said)
        async with asyncio.timeout(WAIT):
            await first.receive()
            while (front._lapsed.wait("127.0.0.1") > 0.0) != (said == b"nonsense"):
                await asyncio.sleep(0.01)
        same = await is_let_in(values[0], WAIT)
        return same is not None, await is_let_in(values[1], 0.5 if said == b"nonsense" else WAIT) is not None


@WAYS
def test_who_was_let_go_for_nonsense_keeps_newcomers_of_the_address_waiting_and_nobody_else(way):
    assert run(open_again(b"nonsense", way)) == (True, False)
    assert run(open_again(b"goodbye", way)) == (True, True)


async def story(limits, way):
    """Open as many sockets as there may be, then one more; return how many are answered, and the last one's status."""
    tokens = Tokens(b"s" * 32)
    async with AsyncExitStack() as opened:
        front = Front(SimpleNamespace(), tokens, None, limits)
        front.open_labs([await opened.enter_async_context(way(echo, limits))])
        url = f"http://127.0.0.1:{await opened.enter_async_context(served(front.app))}"
        browser = await opened.enter_async_context(
            aiohttp.ClientSession(connector=aiohttp.TCPConnector(limit=0), headers={"Origin": url})
        )
        values = [tokens.new() for _ in range(limits.sockets // limits.sockets_each + 1)]

        async def open_one(value):
            cookie = {"Cookie": f"{tokens.cookie}={value}"}
            return await browser.ws_connect(url, protocols=[PROTOCOL], headers=cookie)

        async with asyncio.timeout(WAIT):
            sockets = [await open_one(values[k // limits.sockets_each]) for k in range(limits.sockets)]
            for socket in sockets:
                await socket.send_bytes(b"x")
            answers = [await socket.receive_bytes() for socket in sockets]
            try:
                await open_one(values[-1])
            except aiohttp.WSServerHandshakeError as refused:
                return answers.count(b"x"), refused.status
    return answers.count(b"x"), 101


@WAYS
def test_every_socket_that_the_limits_allow_reaches_its_lab(way):
    limits = Limits()
    assert run(story(limits, way)) == (limits.sockets, 429)
