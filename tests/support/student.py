"""A student without pictures, at a lab that runs."""

from __future__ import annotations

import asyncio
import re
import time
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from support.at_rest import SOON, Traffic, told
from support.fake_browser import FakeBrowser, connected, cookie_of, hang_up

Result = TypeVar("Result")

MOST = 300.0
"""Seconds for one story."""

APART = 0.02
"""Seconds between two looks at a lab."""

DRAWN = "&#34;coming&#34;: false"
"""What the page notes once the picture of its arm is made; where that comes late, the arm is there before it."""

QUIET = SOON + 0.5
"""Seconds in which nothing comes from a lab that has answered, where it cannot be asked, or plays a film."""


def run(main: Coroutine[Any, Any, Result]) -> Result:
    """Run the story of a test in a thread of its own.

    While a browser test's Playwright is open, its event loop occupies the thread of the tests.
    """

    async def story() -> Result:
        try:
            return await asyncio.wait_for(main, MOST)
        finally:
            await hang_up()

    with ThreadPoolExecutor(1) as own:
        return own.submit(lambda: asyncio.run(story())).result()


async def student(url: str, cookie: str | None = None, path: str = "/") -> FakeBrowser:
    """Open the page and wait for arm, handle and panels."""
    browser = FakeBrowser(url, cookie or cookie_of(url + path.lstrip("/")), path)
    await browser.connect()
    await browser.until(lambda: is_open(browser))
    return browser


def is_open(browser: FakeBrowser) -> bool:
    """Return whether arm, handle and panels are there, and the panels know that the arm is drawn."""
    handle, shown = "wxyz" in browser.nodes.get("/target", {}), browser.html()
    return handle and bool(arm_nodes(browser)) and 'data-cell="undo"' in shown and DRAWN in shown


def is_on(browser: FakeBrowser, switch: str) -> bool:
    """Return whether the page shows a switch as on: its button does what it said when it was shown."""
    return re.search(rf'data-cell="{switch}"[^>]*aria-checked="true"', browser.html()) is not None


def arm_nodes(browser: FakeBrowser) -> list[str]:
    """Return the nodes of the joints, from the base on."""
    return sorted(name for name in browser.nodes if "/arm/" in name and name.rsplit("/", 1)[1].isdigit())


async def moves(browser: FakeBrowser) -> None:
    """Wait until a joint of the arm has moved."""
    before = {name: dict(browser.nodes[name]) for name in arm_nodes(browser)}
    await browser.until(lambda: any(browser.nodes[name] != pose for name, pose in before.items()))


async def settled(browser: FakeBrowser) -> None:
    """Wait until the labs of this process have answered all that was said; else until nothing has come for long."""
    since, before = time.monotonic(), None
    while time.monotonic() < since + QUIET:
        received, lab = browser.received, told()
        now = None if lab is None else (lab.idle, lab.traffic, _traffic())
        if now is not None and now == before and lab.idle and lab.traffic == _traffic():
            return
        before = now
        await asyncio.sleep(APART)
        if browser.received != received:
            since = time.monotonic()


def _traffic() -> Traffic:
    browsers = connected()
    return Traffic(sum(each.sent for each in browsers), sum(each.received for each in browsers))
