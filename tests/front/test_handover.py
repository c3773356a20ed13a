"""A browser's socket handed over to a lab that is another process."""

import asyncio
import contextlib
import socket
import sys
import tempfile
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path
from types import SimpleNamespace

import aiohttp
import pytest
from aiohttp import WSCloseCode, web
from websockets.exceptions import ConnectionClosedOK

from armlab.front import reception
from armlab.front.direct import DirectLine
from armlab.front.front import Front
from armlab.front.handover import HandOver
from armlab.front.limits import Limits
from armlab.front.page import make_page
from armlab.front.reception import Reception
from armlab.front.start import Settings, StartError, start
from armlab.front.tokens import Tokens
from support.fake_browser import cookie_of
from support.lab import open_lab, running_lab
from support.patience import WAIT, Patience
from support.student import run, student

PROTOCOL = "viser-v1.1.1"
UPGRADE = (
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Origin: http://127.0.0.1\r\nSec-WebSocket-Protocol: viser-v1.1.1\r\n"
)
KEY = b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"


class Opened:
    """A front whose only lab takes sockets over, and notes what is said of their browsers."""

    def __init__(self, front, reception, port, token, cookie):
        self.front, self.reception, self.port, self.token, self.cookie = front, reception, port, token, cookie
        self.said = []

    async def serve(self, connection):
        """Serve as a lab does that sends back what comes."""
        self.said.append(dict(connection.request.headers.raw_items()))
        with contextlib.suppress(ConnectionClosedOK):
            while True:
                await connection.send(await connection.recv())

    async def until(self, condition):
        patience = Patience()
        while not condition():
            assert patience.left()
            await asyncio.sleep(0.01)

    async def ask(self, *parts):
        """Return the stream of a connection that sends these bytes, as a browser that has been here before."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        writer.write(UPGRADE + b"Cookie: " + self.cookie.encode() + b"\r\n" + b"".join(parts))
        return reader, writer


@asynccontextmanager
async def opened():
    tokens, limits = Tokens(b"s" * 32), Limits()
    async with AsyncExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        front = Front(SimpleNamespace(), tokens, None, limits)
        value = tokens.new()
        found = Opened(front, None, 0, tokens.read(value), f"{tokens.cookie}={value}")
        found.reception = Reception(f"{folder}/lab", DirectLine(found.serve, limits), limits)
        await found.reception.open()
        front.open_labs([HandOver(f"{folder}/lab")])
        runner = web.AppRunner(front.app, shutdown_timeout=0.1)
        await runner.setup()
        stack.push_async_callback(runner.cleanup)
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        found.port = runner.addresses[0][1]
        yield found


def test_a_lab_hears_what_the_front_says_and_nothing_else_of_what_a_browser_claims():
    async def main():
        async with opened() as lab, aiohttp.ClientSession() as browser:
            url = f"http://127.0.0.1:{lab.port}"
            claims = {"X-Armlab-Token": "another", "X-Armlab-Wish": "robot/x"}
            headers = {"Origin": url, "Cookie": lab.cookie, "Accept-Language": "it", **claims}
            connection = await browser.ws_connect(url, protocols=[PROTOCOL], headers=headers)
            for data in (b"1", b"x" * 300_000):
                await connection.send_bytes(data)
                assert await connection.receive_bytes() == data
            assert lab.said == [
                {
                    "X-Armlab-Token": lab.token,
                    "X-Armlab-Origin": url,
                    "X-Armlab-Address": "127.0.0.1",
                    "X-Armlab-Language": "it",
                }
            ]
            assert lab.front._browsers._open[lab.token] == 1
            await connection.close()
            await lab.until(lambda: not lab.front._browsers._open)
            assert not lab.reception._browsers._open

    run(main())


@pytest.mark.parametrize(
    "request_of",
    [
        b"Sec-WebSocket-Key: short\r\nSec-WebSocket-Version: 13\r\n",
        b"Sec-WebSocket-Key: \xc3\xa9\r\nSec-WebSocket-Version: 13\r\n",
        KEY.replace(b"13", b"12"),
    ],
)
def test_a_request_that_opens_no_socket_is_refused_by_the_front(request_of, caplog):
    async def main():
        async with opened() as lab:
            reader, writer = await lab.ask(request_of, b"\r\n")
            assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 400")
            writer.close()
            assert lab.said == []
            assert not lab.front._browsers._open

    run(main())
    assert not caplog.records


@asynccontextmanager
async def handed_over(lab, head):
    """Hand a request over as the front does; yields the browser's side, and the front's when the socket is taken."""
    ours, theirs = socket.socketpair()
    with socket.socket(socket.AF_UNIX) as front, ours:
        ours.settimeout(WAIT)
        front.settimeout(WAIT)
        front.connect(lab.reception._address)
        socket.send_fds(front, [b'{"X-Armlab-Token": "t"}\n' + head], [theirs.fileno()])
        assert await asyncio.to_thread(front.recv, 1) == b"t"
        theirs.close()
        yield ours, front


def test_a_request_that_opens_no_socket_is_refused_by_the_lab_and_none_behind_it_is_read():
    async def main():
        async with opened() as lab, handed_over(lab, UPGRADE + b"\r\n") as (ours, front):
            assert (await asyncio.to_thread(ours.recv, 1000)).startswith(b"HTTP/1.1 400")
            with contextlib.suppress(ConnectionError):
                ours.sendall(UPGRADE + KEY + b"X-Armlab-Token: another\r\n\r\n")
                assert b"HTTP/1.1" not in await asyncio.to_thread(ours.recv, 1000)
            assert await asyncio.to_thread(front.recv, 1) == b"0"
            await lab.until(lambda: len(lab.reception._tasks) == 1)
            assert lab.said == []

    run(main())


@pytest.mark.parametrize(("line", "connection", "status"), [(b"HEAD", b"Upgrade", 200), (b"GET", b"close", 400)])
def test_what_does_not_ask_for_a_socket_becomes_none(line, connection, status):
    request = UPGRADE.replace(b"GET", line).replace(b"Connection: Upgrade", b"Connection: " + connection) + KEY

    async def main():
        async with opened() as lab:
            lab.front._page = make_page()
            reader, writer = await asyncio.open_connection("127.0.0.1", lab.port)
            writer.write(request + b"Cookie: " + lab.cookie.encode() + b"\r\n\r\n")
            assert int((await reader.readuntil(b"\r\n")).split()[1]) == status
            writer.close()
            assert lab.said == []

    run(main())


def test_what_is_no_request_is_refused_and_the_front_told():
    async def main():
        async with opened() as lab, handed_over(lab, b"no request\r\n\r\n") as (ours, front):
            assert (await asyncio.to_thread(ours.recv, 100)).startswith(b"HTTP/1.0 400")
            assert await asyncio.to_thread(front.recv, 1) == b"0"
            await lab.until(lambda: len(lab.reception._tasks) == 1)
            assert lab.said == []

    run(main())


def test_a_browser_that_has_gone_before_the_lab_looks_is_no_news(caplog):
    async def main():
        async with opened() as lab:
            ours, theirs = socket.socketpair()
            ours.close()
            with socket.socket(socket.AF_UNIX) as front:
                front.settimeout(WAIT)
                front.connect(lab.reception._address)
                socket.send_fds(front, [b'{"X-Armlab-Token": "t"}\n' + UPGRADE + KEY + b"\r\n"], [theirs.fileno()])
                theirs.close()
                assert await asyncio.to_thread(front.recv, 1) == b"t"
                assert await asyncio.to_thread(front.recv, 1) == b"0"
            await lab.until(lambda: len(lab.reception._tasks) == 1)
            assert not lab.reception._browsers._open

    run(main())
    assert not caplog.records


def test_a_lab_receives_again_where_that_has_failed(monkeypatch, caplog):
    failures = [OSError(24, "Too many open files")]

    async def main():
        accept = asyncio.get_running_loop().sock_accept

        async def accepted(listener):
            if failures:
                raise failures.pop()
            return await accept(listener)

        monkeypatch.setattr(asyncio.get_running_loop(), "sock_accept", accepted)
        async with opened() as lab:
            reader, writer = await lab.ask(KEY, b"\r\n")
            assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 101")
            writer.close()
            await lab.until(lambda: not lab.front._browsers._open)

    monkeypatch.setattr(reception, "AGAIN", 0.05)
    run(main())
    assert ["no socket can be received" in record.message for record in caplog.records] == [True]


def test_a_lab_that_dies_before_it_holds_a_socket_leaves_its_wish_and_the_browser_comes_again(tmp_path):
    async def main():
        async with opened() as lab:
            with socket.socket(socket.AF_UNIX) as listener:
                listener.bind(str(tmp_path / "lab"))
                listener.listen()
                lab.front.open_labs([HandOver(str(tmp_path / "lab"))])
                lab.front._wishes.put(lab.token, "robot/scara")
                reader, writer = await lab.ask(KEY, b"\r\n")
                front, _ = await asyncio.to_thread(listener.accept)
                await asyncio.to_thread(front.recv, 1 << 16)  # what is read is not reset: the front is told nothing
                front.close()
                assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 503")
                writer.close()
            assert lab.front._wishes.take(lab.token) == "robot/scara"
            assert not lab.front._browsers._open

    run(main())


def test_a_browser_that_breaks_off_at_once_leaves_its_place(caplog):
    async def main():
        async with opened() as lab:
            for _ in range(20):
                _, writer = await lab.ask(KEY, b"\r\n")
                writer.transport.abort()
            await lab.until(lambda: not lab.front._browsers._open and not lab.reception._browsers._open)
            await lab.until(lambda: len(lab.reception._tasks) == 1)  # that which receives the next

    run(main())
    assert not caplog.records


def test_a_lab_that_is_not_there_is_a_request_to_come_again():
    async def main():
        async with opened() as lab:
            lab.front.open_labs([HandOver("/nothing/here")])
            reader, writer = await lab.ask(KEY, b"\r\n")
            assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 503")
            writer.close()
            assert not lab.front._browsers._open

    run(main())


def test_a_front_that_breaks_off_is_no_news(caplog):
    async def main():
        async with opened() as lab:
            address = lab.reception._address
            for data in (b"", b'{"X-Armlab-Token": "t"}\nGET'):
                with socket.socket(socket.AF_UNIX) as front:
                    front.connect(address)
                    if data:
                        ours, theirs = socket.socketpair()
                        socket.send_fds(front, [data], [theirs.fileno()])
                        theirs.close()
                        await asyncio.sleep(0.05)
                await lab.until(lambda: len(lab.reception._tasks) == 1)
            assert await asyncio.to_thread(ours.recv, 1) == b"", "the lab has let the socket go"
            ours.close()

    run(main())
    assert not caplog.records


def test_a_socket_whose_lab_dies_closes_and_the_folder_is_of_one_user(tmp_path, labs):
    async def main(url):
        browser = await student(url, cookie_of(url))
        labs[0]._processes[0].kill()
        patience = Patience()
        while browser.close_code is None:
            assert patience.left()
            await asyncio.sleep(0.01)

    with running_lab(tmp_path, labs=1) as url:
        folder = Path(labs[0].addresses[0]).parent
        assert folder.stat().st_mode & 0o777 == 0o700
        run(main(url))
    assert not folder.exists()


@pytest.mark.parametrize("labs", [0, 1])
def test_pages_are_told_that_the_lab_ends(labs):
    async def main():
        lab = await asyncio.to_thread(open_lab, labs=labs)
        browser = await student(f"http://127.0.0.1:{lab.port}/")
        await asyncio.to_thread(lab.stop)
        patience = Patience()
        while browser.close_code is None:
            assert patience.left()
            await asyncio.sleep(0.01)
        assert browser.close_code == WSCloseCode.GOING_AWAY

    run(main())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_the_labs_of_a_class_listen_at_no_port(labs):
    with running_lab(labs=1) as url:
        assert run(is_open(url))
        (process,) = labs[0]._processes
        assert not ports_of(process.pid)
        assert ports_of("self")


async def is_open(url):
    browser = await student(url)
    await browser.close()
    return True


def ports_of(pid):
    """Return the sockets of a process that wait for connections over the network, by their numbers."""
    lines = [line.split() for kind in ("tcp", "tcp6") for line in Path(f"/proc/net/{kind}").read_text().splitlines()]
    listening = {f"socket:[{line[9]}]" for line in lines if line[3] == "0A"}
    files = Path(f"/proc/{pid}/fd").iterdir()
    return listening & {str(file.readlink()) for file in files if file.is_symlink()}


def test_a_system_that_cannot_do_it_says_so_at_the_start(monkeypatch):
    monkeypatch.delattr(socket, "send_fds")
    with pytest.raises(StartError, match="leave --labs out"):
        start(Settings("127.0.0.1", [0], "puma560", None, labs=2))
