"""A socket passed through to a lab: how it ends."""

import asyncio
from types import SimpleNamespace

import pytest
from aiohttp import ClientConnectionResetError, WSCloseCode, WSMessage, WSMsgType

from armlab.front.limits import Limits, Meter
from armlab.front.relay import relay
from support.student import run


class Side:
    """A connection with one message to read, after which it is silent."""

    def __init__(self, sends=None):
        self.close_code, self.closed, self._sends = None, [], sends

    async def __aiter__(self):
        yield WSMessage(WSMsgType.BINARY, b"x", None)
        await asyncio.sleep(10.0)

    async def send_bytes(self, data):
        if self._sends is not None:
            raise self._sends

    async def close(self, code=WSCloseCode.OK):
        self.closed.append(code)
        return True


def ended(problem, code=None):
    """Return both sides after the lab could not take a message because of a problem, and ended with this code."""
    browser, lab = Side(), Side(problem)
    lab.close_code = code
    run(relay(lab, SimpleNamespace(transport=None), browser, Meter(Limits())))
    return browser, lab


def test_what_should_never_end_a_connection_is_logged_and_ends_it(caplog):
    browser, lab = ended(AssertionError("two at once"))
    assert [record.exc_info[1].args for record in caplog.records] == [("two at once",)]
    assert browser.closed == [WSCloseCode.SERVICE_RESTART]
    assert lab.closed == [WSCloseCode.OK]


@pytest.mark.parametrize("problem", [ConnectionResetError(), ClientConnectionResetError()])
def test_a_connection_that_breaks_is_no_news(problem, caplog):
    browser, _ = ended(problem)
    assert not caplog.records
    assert browser.closed == [WSCloseCode.SERVICE_RESTART]


@pytest.mark.parametrize(
    ("code", "told"),
    [
        (WSCloseCode.ABNORMAL_CLOSURE, WSCloseCode.SERVICE_RESTART),
        (1005, WSCloseCode.SERVICE_RESTART),
        (WSCloseCode.INTERNAL_ERROR, WSCloseCode.INTERNAL_ERROR),
        (WSCloseCode.GOING_AWAY, WSCloseCode.GOING_AWAY),
    ],
)
def test_a_browser_is_told_how_its_lab_ended_by_a_code_that_may_be_sent(code, told):
    browser, _ = ended(ConnectionResetError(), code)
    assert browser.closed == [told]
