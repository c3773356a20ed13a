"""What the adapter assumes of viser, against a running viser; when viser's pin moves, these say what has to follow."""

import asyncio
import threading
import warnings

import numpy as np
import pytest
import viser
from viser import _icons
from viser.infra import _infra

from armlab.errors import InputError
from armlab.running_loop import running_loop
from armlab.session.pages import tabs
from armlab.ui import adapter, quick
from armlab.ui.manners import Manners
from support.bare import SAID, Bare


@pytest.fixture
def bare():
    started = Bare()
    yield started
    started.stop()


@pytest.fixture
def loop():
    with running_loop("of the test") as running:
        yield running


async def name_of_thread():
    return threading.current_thread().name


def test_it_says_nothing_on_standard_output(capsys, loop):
    server, _ = adapter.make_server(loop, Manners())
    adapter.stop_server(server)
    assert capsys.readouterr().out == ""


def test_a_server_has_no_port_and_no_loop_of_its_own(loop):
    threads = threading.active_count()
    before = _infra.asyncio, _infra.websockets.asyncio.server.serve
    server, serve = adapter.make_server(loop, Manners())
    assert callable(serve)
    assert server.get_port() == 0
    assert asyncio.run_coroutine_threadsafe(name_of_thread(), server.get_event_loop()).result(5.0) == "of the test"
    adapter.stop_server(server)
    assert loop.is_running()
    assert threading.active_count() == threads
    assert (_infra.asyncio, _infra.websockets.asyncio.server.serve) == before


def test_the_headers_of_a_connection_can_be_read(bare):
    async def work(_browser, do):
        headers = await do(lambda: adapter.request_headers(bare.server, bare.client))
        assert headers == SAID

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


def test_what_is_said_to_a_page_that_has_gone_is_no_warning():
    async def work(browser, do):
        gone = asyncio.Event()
        bare.server.on_client_disconnect(lambda _client: gone.set())
        await browser.close()
        while not gone.is_set():
            await asyncio.sleep(0.01)
        await do(lambda: adapter.set_content(bare.markup, "too late"))
        await do(lambda: adapter.set_position(bare.handle, (1.0, 2.0, 3.0)))

    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        bare = Bare()
        bare.run(work)
        bare.stop()
    assert [one for one in said if "closed connection" in str(one.message)] == []


def test_icons_are_those_of_viser_and_its_archive_is_opened_once(bare, monkeypatch):
    names = [getattr(viser.Icon, first.icon) for first, *_ in tabs().values()]
    svg_from_icon = _icons.svg_from_icon
    expected = [svg_from_icon(name) for name in names]
    quick._icons()
    monkeypatch.setattr(_icons.zipfile, "ZipFile", None)  # neither viser nor the lab opens it again
    quick.icon.cache_clear()
    assert [quick.icon(name) for name in names] == expected

    async def work(_browser, do):
        await do(lambda: [bare.client.gui.add_button("B", icon=name) for name in names])
        await do(lambda: bare.client.gui.add_tab_group().add_tab("T", names[0]))

    bare.run(work)
