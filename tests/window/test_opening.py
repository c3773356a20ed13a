"""Many who open the lab at once: their pages are built one after the other, with time for others in between."""

import asyncio
import gc
import itertools
import threading
import time
import weakref

from armlab.ui.pace import BUILDING
from armlab.window.view import View
from support.fake_browser import FakeBrowser, cookie_of
from support.patience import Patience
from support.student import is_open, run, student

CLASS = 5
END = object()


def test_pages_are_built_in_turn_in_pieces_and_others_have_most_of_the_time(url, monkeypatch):
    pieces = []
    build = View.build

    def noted(view, panel):
        page, parts = next(numbers), build(view, panel)
        while True:
            began = time.perf_counter()
            more = next(parts, END) is not END
            pieces.append((page, began, time.perf_counter()))
            if not more:
                return
            yield

    monkeypatch.setattr(View, "build", noted)
    numbers = itertools.count()

    async def main():
        first = await student(url)
        browsers = [FakeBrowser(url, cookie_of(url)) for _ in range(CLASS)]
        await asyncio.gather(*(browser.connect() for browser in browsers))
        for browser in browsers:
            await browser.until(lambda browser=browser: is_open(browser))
        await first.set_value(first.slider(1), 12.0)
        for browser in (first, *browsers):
            await browser.close()

    run(main())
    pages = [page for page, _, _ in pieces]
    assert pages == sorted(pages), "one page after the other"
    assert len(set(pages)) == CLASS + 1
    assert min(pages.count(page) for page in set(pages)) > 20
    # Beside the first: from the beginning of each to the beginning of the next, whose own first piece is not in it yet.
    for page in range(1, CLASS):
        mine = [(began, ended) for one, began, ended in pieces if one == page]
        following = next(began for one, began, _ in pieces if one == page + 1)
        worked = sum(ended - began for began, ended in mine)
        assert following - mine[0][0] >= 0.9 * worked / BUILDING


def test_a_page_that_cannot_be_built_does_not_keep_others_out(url, monkeypatch):
    build, failed = View.build, []

    def failing(view, panel):
        if not failed:
            failed.append(view)
            raise RuntimeError("this page cannot be built")
        yield from build(view, panel)

    monkeypatch.setattr(View, "build", failing)

    async def main():
        unlucky = FakeBrowser(url, cookie_of(url))
        await unlucky.connect()
        await unlucky.until(lambda: bool(failed))
        other = await student(url)
        await other.close()
        await unlucky.close()

    run(main())


def test_a_page_that_goes_while_it_is_built_is_not_shown_anything(url, monkeypatch):
    build, half, gone = View.build, threading.Event(), threading.Event()

    def slow(view, panel):
        pieces = build(view, panel)
        next(pieces)
        views.append(view)
        half.set()
        while not gone.is_set():
            yield
        yield from pieces

    def noted(view):
        close(view)
        closed.append(view)

    views, closed, close = [], [], View.close
    monkeypatch.setattr(View, "build", slow)
    monkeypatch.setattr(View, "close", noted)

    async def main():
        leaving = FakeBrowser(url, cookie_of(url))
        await leaving.connect()
        await leaving.until(half.is_set)
        await leaving.close()
        patience = Patience()
        while views[0] not in closed and patience.left():  # a page of the test before may close as well
            await asyncio.sleep(0.01)
        gone.set()
        assert [view for view in closed if view in views] == views
        other = await student(url)
        await other.close()

    run(main())


def test_of_a_page_that_has_gone_nothing_is_left(url, monkeypatch):
    there, build = [], View.build

    def noted(view, panel):
        there.extend(map(weakref.ref, (view, view.client)))
        return build(view, panel)

    monkeypatch.setattr(View, "build", noted)

    async def main():
        for _ in range(3):
            browser = await student(url)
            await browser.open("workspace")
            await browser.set_value(browser.slider(1), 12.0)
            await browser.close()

    run(main())
    patience = Patience()
    while any(ref() is not None for ref in there) and patience.left():
        gc.collect()
        time.sleep(0.05)
    assert len(there) == 6
    assert all(ref() is None for ref in there)


def test_what_is_there_from_the_start_is_not_looked_at_by_the_collector_of_garbage(url):
    patience = Patience()
    while not gc.get_freeze_count() and patience.left():
        time.sleep(0.01)
    assert gc.get_freeze_count() > 50_000
