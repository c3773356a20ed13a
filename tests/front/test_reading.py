"""A page that stops reading: what waits for it is bounded, it is cut off, and others notice nothing."""

import asyncio
import gc
import os
import weakref
from functools import partial

import pytest

from armlab.front import direct
from armlab.front import start as start_module
from armlab.front.limits import Limits
from armlab.ui import adapter
from armlab.window import lab as lab_module
from support.fake_browser import FakeBrowser
from support.lab import running_lab
from support.patience import Patience
from support.student import run, student

PIECE, PIECES = 500_000, 100
"""Bytes of what is shown anew, and how often."""


class Opened:
    """A lab whose parts can be looked at, and which soon asks its pages whether they read."""

    def __init__(self, monkeypatch):
        self.lines, self.labs = [], []

        class NotedLine(direct.DirectLine):
            def __init__(own, *parts):  # noqa: N805
                super().__init__(*parts)
                self.lines.append(own)

        class NotedLab(lab_module.Lab):
            def __init__(own, *parts):  # noqa: N805
                super().__init__(*parts)
                self.labs.append(own)

        monkeypatch.setattr(start_module, "Limits", partial(Limits, heartbeat=1.5))
        monkeypatch.setattr(direct, "DirectLine", NotedLine)
        monkeypatch.setattr(lab_module, "Lab", NotedLab)
        monkeypatch.setattr(direct, "CLOSING", 0.3)

    async def on_loop(self, work):
        """Run something on the lab's loop."""

        async def there():
            return work()

        return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(there(), self.labs[0].loop))

    def waiting(self):
        """Return the bytes that wait in the front and the messages that wait in the lab, of the fullest connection."""
        sockets = [ws._writer.transport for ws in list(self.lines[0]._open) if ws._writer is not None]
        buffers = [state.message_buffer for state in self.labs[0].server._websock_server._client_state_from_id.values()]
        return (
            max((socket.get_write_buffer_size() for socket in sockets), default=0),
            max((len(buffer.message_from_id) for buffer in buffers), default=0),
        )


@pytest.fixture
def opened(monkeypatch):
    found = Opened(monkeypatch)
    with running_lab() as url:
        found.url = url
        yield found


async def gone(condition):
    patience = Patience()
    while not condition():
        assert patience.left()
        await asyncio.sleep(0.05)


async def stream(opened, client, other):
    """Show a page much that is new, while another page is used; return the most that has waited."""
    shown = await opened.on_loop(lambda: client.gui.add_html(""))
    most = (0, 0)
    for k in range(PIECES):
        text = os.urandom(PIECE // 2).hex()
        await opened.on_loop(lambda text=text: (adapter.set_content(shown, text), client.flush()))
        most = tuple(map(max, most, opened.waiting()))
        if k % 20 == 0:
            before = other.counts["SetOrientationMessage"]
            await other.set_value(other.slider(1), 10.0 + k)
            await other.until(lambda before=before: other.counts["SetOrientationMessage"] > before)
    return most


def test_a_page_that_stops_reading_is_cut_off_and_others_notice_nothing(opened):
    async def main():
        stopped, lab = await student(opened.url), opened.labs[0]
        ((token, views),) = lab._of_session.items()
        view = weakref.ref(next(iter(views)))
        (client,) = lab.server.get_clients().values()
        other = await student(opened.url)
        stopped._socket.transport.pause_reading()
        bytes_waiting, messages_waiting = await stream(opened, client, other)
        assert bytes_waiting <= 4 * PIECE, "of what was shown, the front holds a few pieces"
        assert messages_waiting <= 200, "what is shown anew takes the place of what waits"
        await gone(lambda: token not in lab._of_session)
        client = None
        await gone(lambda: gc.collect() >= 0 and view() is None)
        assert other.close_code is None
        stopped._socket.transport.resume_reading()
        again = FakeBrowser(opened.url, stopped.cookie)
        await again.connect()
        await again.until(lambda: "/target" in again.nodes)

    run(main())
