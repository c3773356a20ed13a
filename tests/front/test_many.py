"""As many sockets as the limits allow pass through the front at a time."""

import asyncio
from contextlib import AsyncExitStack, asynccontextmanager
from types import SimpleNamespace

import aiohttp
from aiohttp import WSCloseCode, web

from armlab.front.front import Front
from armlab.front.limits import Limits
from armlab.front.page import make_page
from armlab.front.tokens import Tokens
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


async def echo(request):
    """Send back what comes, as a lab that has nothing else to do."""
    socket = web.WebSocketResponse(protocols=[PROTOCOL])
    await socket.prepare(request)
    async for message in socket:
        await socket.send_bytes(message.data)
    return socket


def test_who_asks_too_often_is_answered_later():
    async def main():
        limits = Limits(requests=3.0, request_rate=1e-6, request_wait=0.3)
        front = Front(make_page(), Tokens(b"s" * 32), "secret", [], None, limits)
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


def echoing():
    app = web.Application()
    app.router.add_get("/", echo)
    return app


async def offended(request):
    """Close as a lab does that was sent what it cannot unpack."""
    socket = web.WebSocketResponse(protocols=[PROTOCOL])
    await socket.prepare(request)
    async for message in socket:
        await socket.close(code=WSCloseCode.INTERNAL_ERROR if message.data == b"nonsense" else WSCloseCode.GOING_AWAY)
    return socket


async def open_again(said):
    """Return whether a browser is let in again, and a newcomer, after the lab has closed for what the first one said.

    A newcomer who has to wait would wait for days.
    """
    tokens, limits = Tokens(b"s" * 32), Limits(lapses=0.0, lapse_rate=1e-6, newcomers_wait=1e6)
    app = web.Application()
    app.router.add_get("/", offended)
    async with AsyncExitStack() as opened:
        lab = await opened.enter_async_context(served(app))
        front = Front(SimpleNamespace(), tokens, "secret", [lab], None, limits)
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


def test_who_was_let_go_for_nonsense_keeps_newcomers_of_the_address_waiting_and_nobody_else():
    assert run(open_again(b"nonsense")) == (True, False)
    assert run(open_again(b"goodbye")) == (True, True)


async def story(limits):
    """Open as many sockets as there may be, then one more; return how many are answered, and the last one's status."""
    tokens = Tokens(b"s" * 32)
    async with AsyncExitStack() as opened:
        lab = await opened.enter_async_context(served(echoing()))
        front = Front(SimpleNamespace(), tokens, "secret", [lab], None, limits)
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


def test_every_socket_that_the_limits_allow_reaches_its_lab():
    limits = Limits()
    assert run(story(limits)) == (limits.sockets, 429)
