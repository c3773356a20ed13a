"""Many who open the lab at once: their pages are built one after the other, with time for others in between."""

import asyncio
import time
from itertools import pairwise

from armlab.ui import lab as module
from armlab.ui.lab import BUILDING, Lab
from support.fake_browser import FakeBrowser, cookie_of
from support.student import is_open, run, student

CLASS = 5


def test_pages_are_built_in_turn_and_others_have_most_of_the_time(url, monkeypatch):
    built = []
    build = Lab._open

    def noted(*parts):
        began = time.perf_counter()
        build(*parts)
        built.append((began, time.perf_counter()))

    monkeypatch.setattr(Lab, "_open", noted)

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
    assert len(built) == CLASS + 1
    for (began, ended), (following, _) in pairwise(built):
        # The clocks of the loop and of this test are read at slightly different moments.
        assert following - ended >= 0.9 * (ended - began) * (1.0 / BUILDING - 1.0)


def test_a_page_that_cannot_be_built_does_not_keep_others_out(url, monkeypatch):
    build, failed = Lab._open, []

    def failing(*parts):
        if not failed:
            failed.append(parts)
            raise RuntimeError("this page cannot be built")
        build(*parts)

    monkeypatch.setattr(module.Lab, "_open", failing)

    async def main():
        unlucky = FakeBrowser(url, cookie_of(url))
        await unlucky.connect()
        await unlucky.until(lambda: bool(failed))
        other = await student(url)
        await other.close()
        await unlucky.close()

    run(main())
