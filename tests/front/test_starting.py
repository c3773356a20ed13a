"""A page that is asked for while the lab behind the front is still being made."""

import asyncio
import gc
import threading
import time
import weakref
from pathlib import Path

import aiohttp
import pytest
import websockets

from armlab.errors import InputError, PluginError
from armlab.front import front as front_module
from armlab.front import start as start_module
from armlab.front.paper_pages import PaperPages
from armlab.front.start import Settings, start
from armlab.window import lab as lab_module
from support.fake_browser import FakeBrowser, cookie_of
from support.patience import WAIT, Patience
from support.student import run, student

SETTINGS = Settings("127.0.0.1", [0], "planar_2r", None)


def url_of(port):
    return f"http://127.0.0.1:{port}/"


def test_a_socket_waits_for_the_lab_and_then_its_page_opens(monkeypatch):
    fronts, stories = [], []

    class NotedFront(front_module.Front):
        def __init__(self, *parts, **named):
            super().__init__(*parts, **named)
            fronts.append(self)

    class LateLab(lab_module.Lab):
        def __init__(self, *parts):
            patience = Patience()
            while not fronts[0]._browsers._open.total() and patience.left():
                threading.Event().wait(0.01)
            assert fronts[0]._browsers._open.total() == 1, "the socket waits"
            super().__init__(*parts)

    async def visit(url):
        browser = await student(url)
        await browser.close()

    def visited(port):
        stories.append(threading.Thread(target=lambda: (run(visit(url_of(port))), stories.append("opened"))))
        stories[0].start()

    monkeypatch.setattr(start_module, "Front", NotedFront)
    monkeypatch.setattr(lab_module, "Lab", LateLab)
    monkeypatch.setattr(front_module, "STARTING", WAIT)
    lab = start(SETTINGS, visited)
    stories[0].join()
    lab.stop()
    assert stories[1:] == ["opened"]


def test_a_socket_that_has_waited_too_long_is_told_to_come_again(monkeypatch):
    monkeypatch.setattr(front_module, "STARTING", 0.02)
    told = []

    async def early(url):
        browser = FakeBrowser(url, cookie_of(url))
        with pytest.raises(websockets.InvalidStatus) as refused:
            await browser.connect()
        told.append((refused.value.response.status_code, browser))

    async def again(url):
        browser = await student(url)
        await browser.close()

    lab = start(SETTINGS, lambda port: run(early(url_of(port))))
    run(again(url_of(lab.port)))
    lab.stop()
    assert told[0][0] == 503


def test_a_lab_that_cannot_be_made_closes_the_front_too(monkeypatch):
    served = []

    def broken(*_):
        raise PluginError("armlab.benches.x.y.state: cannot be imported")

    monkeypatch.setattr(lab_module, "Lab", broken)
    with pytest.raises(PluginError, match=r"x\.y\.state"):
        start(SETTINGS, served.append)
    with pytest.raises(OSError, match="refused"):
        cookie_of(url_of(served[0]))


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (Settings("127.0.0.1", [0], "puma650", None), "puma560"),
        (
            Settings("127.0.0.1", [0], "puma560", None, lessons=(Path("no/folder"),)),
            "expected a folder, got 'no/folder'",
        ),
    ],
)
def test_what_is_not_there_is_refused_before_a_page_is_served(settings, told):
    served = []
    with pytest.raises(InputError, match=told):
        start(settings, served.append)
    assert served == []


def test_a_lab_that_has_ended_is_forgotten_with_its_pages():
    async def visit(url):
        browser = await student(url)
        await browser.close()

    lab = start(SETTINGS)
    run(visit(url_of(lab.port)))
    lab.stop()
    ended, lab = weakref.ref(lab.lab), None
    patience = Patience()
    while patience.left() and ended() is not None:  # a thread of the lab may still be on its way out
        gc.collect()
        time.sleep(0.01)
    assert ended() is None


def test_a_lab_that_fails_as_it_is_made_leaves_no_thread_behind(monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(lab_module, "Store", full)
    before = set(threading.enumerate())
    with pytest.raises(OSError, match="No space"):
        start(SETTINGS)
    patience = Patience()
    while patience.left() and (left := set(threading.enumerate()) - before):
        time.sleep(0.01)
    assert not left


def test_slow_pages_to_print_keep_nobody_out(monkeypatch):
    """More ask for them than there are threads for whoever gets in."""
    made = threading.Event()

    def slow(*_):
        made.wait(WAIT)

    monkeypatch.setattr(PaperPages, "page", slow)

    async def visit(url):
        async with aiohttp.ClientSession() as client:
            asking = [asyncio.create_task(client.get(f"{url}formulas")) for _ in range(90)]
            await asyncio.sleep(0.5)
            browser = await student(url)
            assert not any(each.done() for each in asking)
            made.set()
            assert {answer.status for answer in await asyncio.gather(*asking)} == {404}
            await browser.close()

    lab = start(SETTINGS)
    run(visit(url_of(lab.port)))
    lab.stop()
