"""What the adapter assumes of viser, against a running viser; when viser's pin moves, these say what has to follow."""

import asyncio
import threading

import numpy as np
import pytest
from viser import _messages

from armlab.errors import InputError
from armlab.ui import adapter
from support.fake_browser import FakeBrowser
from support.student import run


class Bare:
    """A viser server with one student, a slider, some markup and a handle."""

    def __init__(self):
        self.server = adapter.make_server(0)
        self.heard, self.client = [], None
        self.there = threading.Event()
        self.server.on_client_connect(self._build)

    async def _build(self, client):
        self.client = client
        adapter.refuse_uploads(client)
        self.slider = client.gui.add_slider("Joint", -1.0, 1.0, 0.01, 0.0)
        self.markup = client.gui.add_html("before")
        self.frame = client.scene.add_frame("/frame")
        self.handle = client.scene.add_transform_controls("/target")
        adapter.on_event(self.slider, "on_update", lambda event: self.heard.append(event.target.value))
        adapter.on_event(self.handle, "on_update", lambda event: self.heard.append(event.phase))
        self.there.set()

    def run(self, work):
        """Run ``work(browser, do)`` with a connected browser; ``do`` calls something on viser's loop."""
        loop = self.server.get_event_loop()

        async def do(function):
            async def there():
                found = function()
                self.client.flush()
                return found

            return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(there(), loop))

        async def main():
            browser = FakeBrowser(f"http://127.0.0.1:{self.server.get_port()}", None)
            await browser.connect()
            await browser.until(lambda: "/target" in browser.nodes and self.there.is_set())
            await work(browser, do)
            await browser.close()

        run(main())


@pytest.fixture
def bare():
    started = Bare()
    yield started
    adapter.stop_server(started.server)


def test_it_says_nothing_on_standard_output(capsys):
    server = adapter.make_server(0)
    adapter.stop_server(server)
    assert capsys.readouterr().out == ""


def test_nobody_can_open_a_public_tunnel(bare):
    handlers = bare.server._websock_server._incoming_handlers
    assert handlers, "viser keeps its handlers elsewhere now"
    for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        assert not handlers.get(message)


def test_the_headers_of_a_connection_can_be_read(bare):
    async def work(_browser, do):
        headers = await do(lambda: adapter.request_headers(bare.server, bare.client))
        assert headers["Host"] == f"127.0.0.1:{bare.server.get_port()}"

    bare.run(work)


def test_values_of_the_lab_reach_the_page_and_call_nobody_back(bare):
    async def work(browser, do):
        await do(lambda: adapter.set_value(bare.slider, 0.25))
        await do(lambda: adapter.set_content(bare.markup, "after"))
        await browser.until(lambda: browser.control("Joint")["value"] == 0.25 and "after" in browser.html())
        await do(lambda: None)
        assert bare.heard == []
        assert bare.slider.value == 0.25

    bare.run(work)


def test_a_value_that_stands_already_is_not_sent_again(bare):
    async def work(browser, do):
        await do(lambda: adapter.set_value(bare.slider, 0.25))
        await browser.until(lambda: browser.control("Joint")["value"] == 0.25)
        sent = browser.counts["GuiUpdateMessage"]
        await do(lambda: adapter.set_value(bare.slider, 0.25))
        await do(lambda: adapter.set_value(bare.slider, 0.5))
        await browser.until(lambda: browser.control("Joint")["value"] == 0.5)
        assert browser.counts["GuiUpdateMessage"] == sent + 1

    bare.run(work)


def test_a_students_events_come_in_order(bare):
    async def work(browser, do):
        await browser.set_value(browser.control("Joint"), 0.1)
        await browser.drag("start")
        await browser.drag("update", (0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0))
        await browser.drag("end")
        await browser.set_value(browser.control("Joint"), 0.2)
        for _ in range(200):
            if len(bare.heard) == 5:
                break
            await asyncio.sleep(0.01)
        assert bare.heard == [0.1, "start", "update", "end", 0.2]
        assert np.allclose(bare.handle.position, (0.1, 0.2, 0.3))

    bare.run(work)


def test_poses_are_sent_however_small_the_move(bare):
    async def work(browser, do):
        await do(lambda: adapter.set_position(bare.frame, (1e-9, 0.0, 0.0)))
        await do(lambda: adapter.set_wxyz(bare.frame, (1.0, 1e-9, 0.0, 0.0)))
        await browser.until(lambda: browser.nodes.get("/frame", {}).get("position") == [1e-9, 0.0, 0.0])
        await browser.until(lambda: browser.nodes["/frame"].get("wxyz") == [1.0, 1e-9, 0.0, 0.0])

    bare.run(work)


def test_no_page_can_fill_the_memory_with_files(bare):
    async def work(browser, do):
        start = {"mime_type": "text/plain", "part_count": 3, "size_bytes": 3 << 20, "filename": "x"}
        uuid, transfer = browser.control("Joint")["uuid"], "a" * 32
        await browser.send(
            {
                "type": "FileTransferStartUpload",
                "source_component_uuid": uuid,
                "transfer_uuid": transfer,
                **start,
            }
        )
        part = {"type": "FileTransferPart", "source_component_uuid": uuid, "transfer_uuid": transfer}
        await browser.send({**part, "part_index": 0, "content": b"x" * 1000})
        await browser.set_value(browser.control("Joint"), 0.3)
        for _ in range(200):
            if bare.heard == [0.3]:
                break
            await asyncio.sleep(0.01)
        assert bare.heard == [0.3]
        assert not bare.client.gui._current_file_upload_states

    bare.run(work)


def test_what_is_removed_is_left_alone(bare):
    async def work(browser, do):
        await do(bare.slider.remove)
        assert adapter.is_removed(bare.slider)
        assert not adapter.is_removed(bare.markup)
        await do(lambda: adapter.set_value(bare.slider, 0.7))
        await do(lambda: adapter.set_content(bare.markup, "still here"))
        await browser.until(lambda: "still here" in browser.html())

    bare.run(work)


def test_a_refusal_in_a_callback_stays_where_it_is(bare, caplog):
    def refuse(_event):
        raise InputError("no such thing")

    async def work(browser, do):
        await do(lambda: adapter.on_event(bare.slider, "on_update", refuse))
        await browser.set_value(browser.control("Joint"), 0.3)
        await browser.set_value(browser.control("Joint"), 0.4)
        for _ in range(200):
            if bare.heard == [0.3, 0.4]:
                break
            await asyncio.sleep(0.01)
        assert bare.heard == [0.3, 0.4]

    bare.run(work)
    assert "an event was refused: no such thing" in caplog.text


def test_a_mistake_in_a_callback_is_logged_and_later_events_arrive(bare, caplog):
    def fail(_event):
        raise ZeroDivisionError

    async def work(browser, do):
        await do(lambda: adapter.on_event(bare.slider, "on_update", fail))
        await browser.set_value(browser.control("Joint"), 0.3)
        for _ in range(200):
            if bare.heard == [0.3] and "ZeroDivisionError" in caplog.text:
                break
            await asyncio.sleep(0.01)
        assert bare.heard == [0.3]

    bare.run(work)
    assert "an event failed" in caplog.text
    assert "ZeroDivisionError" in caplog.text
