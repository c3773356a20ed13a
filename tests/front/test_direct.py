"""The line to a lab in the same process: how it ends."""

import asyncio
import contextlib
import gc
from types import SimpleNamespace

import pytest
from aiohttp import ClientConnectionResetError, WSCloseCode, WSMessage, WSMsgType
from websockets.exceptions import ConnectionClosedOK

from armlab.front import direct
from armlab.front.direct import Direct, DirectLine
from armlab.front.limits import Limits, Meter
from armlab.front.line import PROTOCOL
from armlab.ui.adapter import NotAMessage
from support.patience import WAIT
from support.student import run


class Browser:
    """A connection that has sent these messages, and may break when something is sent to it."""

    def __init__(self, *messages, breaks=None):
        self._messages, self._breaks = list(messages), breaks
        self.close_code, self.closed, self.sent = None, [], []

    async def receive(self):
        return self._messages.pop(0)

    async def send_bytes(self, data):
        if self._breaks is not None:
            raise self._breaks
        self.sent.append(data)

    async def close(self, code=WSCloseCode.OK, message=b""):
        self.closed.append(code)


def message(kind, data=None):
    return WSMessage(kind, data, None)


REQUEST = SimpleNamespace(transport=None, headers={PROTOCOL: "viser-v1"})


class Line(DirectLine):
    """A line to which this browser comes."""

    def __init__(self, browser, serve, limits):
        super().__init__(serve, limits)
        self._browser = browser

    async def _accepted(self, _request):
        return self._browser


def ended(browser, serve, limits=None):
    """Return whether a lab that serves so has ended a connection for nonsense."""
    line = Line(browser, serve, limits or Limits())
    return run(line.serve(REQUEST, {"X-Armlab-Token": "t"}, Meter(limits or Limits()))).was_nonsense


async def echo(connection):
    """Serve as viser does: what closes a connection is no fault."""
    with contextlib.suppress(ConnectionClosedOK):
        while True:
            await connection.send(await connection.recv())


def test_the_lab_hears_what_the_front_says_and_what_the_browser_sends():
    async def serve(connection):
        assert connection.request.headers["x-armlab-token"] == "t"
        assert connection.subprotocol == "viser-v1"
        await echo(connection)

    browser = Browser(message(WSMsgType.BINARY, b"1"), message(WSMsgType.BINARY, b"2"), message(WSMsgType.CLOSED))
    assert not ended(browser, serve)
    assert (browser.sent, browser.closed) == ([b"1", b"2"], [WSCloseCode.OK])


@pytest.mark.parametrize(
    ("kind", "code", "nonsense"),
    [
        (WSMsgType.TEXT, WSCloseCode.UNSUPPORTED_DATA, True),
        (WSMsgType.ERROR, WSCloseCode.OK, False),
        (WSMsgType.CLOSING, WSCloseCode.OK, False),
    ],
)
def test_what_is_no_binary_message_ends_it(kind, code, nonsense):
    browser = Browser(message(kind, "text"))
    assert ended(browser, echo) is nonsense
    assert browser.closed == [code]


def test_who_floods_for_too_long_is_let_go():
    many = [message(WSMsgType.BINARY, b"x")] * 5
    browser = Browser(*many, message(WSMsgType.CLOSED))
    assert ended(browser, echo, Limits(rate=1000.0, burst=1.0, patience=0.0))
    assert browser.closed == [WSCloseCode.POLICY_VIOLATION]
    assert 1 <= len(browser.sent) < len(many)


@pytest.mark.parametrize("problem", [ConnectionResetError(), ClientConnectionResetError()])
def test_a_browser_that_has_gone_is_no_news(problem, caplog):
    browser = Browser(message(WSMsgType.BINARY, b"x"), breaks=problem)
    assert not ended(browser, echo)
    assert (browser.closed, caplog.records) == ([WSCloseCode.OK], [])


def test_what_cannot_be_read_is_nonsense_and_a_fault_of_ours_is_logged(caplog):
    def failing(problem):
        async def serve(_connection):
            raise problem

        return serve

    browser = Browser()
    assert ended(browser, failing(NotAMessage("half of one")))
    assert (browser.closed, caplog.records) == ([WSCloseCode.INTERNAL_ERROR], [])
    browser = Browser()
    assert not ended(browser, failing(AssertionError("two at once")))
    assert browser.closed == [WSCloseCode.SERVICE_RESTART]
    assert [record.exc_info[1].args for record in caplog.records] == [("two at once",)]


def test_the_lab_may_close_it_with_a_code_of_its_own():
    async def serve(connection):
        await connection.close(WSCloseCode.PROTOCOL_ERROR, "another version")

    browser = Browser()
    assert ended(browser, serve)
    assert browser.closed == [WSCloseCode.PROTOCOL_ERROR] * 2


def test_a_message_that_came_too_early_waits():
    async def main():
        meter = Meter(Limits(rate=20.0, burst=1.0))
        connection = Direct(REQUEST, Browser(*[message(WSMsgType.BINARY, b"x")] * 3), meter, {})
        began = asyncio.get_running_loop().time()
        for _ in range(3):
            await connection.recv()
        assert asyncio.get_running_loop().time() - began > 0.04

    run(main())


class Silent(Browser):
    """A browser that takes no goodbye."""

    async def close(self, code=WSCloseCode.OK, message=b""):
        await super().close(code)
        await asyncio.Event().wait()


@pytest.mark.parametrize("ends", ["the visit", "the lab"])
def test_who_is_taken_away_while_a_page_is_let_go_leaves_no_complaint(ends):
    complaints = []

    async def story():
        loop = asyncio.get_running_loop()
        loop.set_exception_handler(lambda _loop, context: complaints.append(context["message"]))
        browser = Silent(message(WSMsgType.CLOSED))
        line = Line(browser, echo, Limits())
        line._open.add(browser)
        work = line.serve(REQUEST, {}, Meter(Limits())) if ends == "the visit" else line.say_goodbye()
        going = asyncio.create_task(work)
        while not browser.closed:
            await asyncio.sleep(0)
        going.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await going
        assert going.cancelled()
        del going, work
        gc.collect()

    run(story())
    assert complaints == []


@pytest.mark.parametrize("wait", ["CLOSING", "GOODBYE"])
def test_a_page_that_takes_no_goodbye_keeps_no_lab_from_its_end(wait, monkeypatch):
    monkeypatch.setattr(direct, wait, 0.01)
    browser = Silent(message(WSMsgType.CLOSED))
    line = Line(browser, echo, Limits())
    line._open.add(browser)
    work = line.serve(REQUEST, {}, Meter(Limits())) if wait == "CLOSING" else line.say_goodbye()
    run(asyncio.wait_for(work, WAIT))
    assert len(browser.closed) == 1
