"""What each panel and each overlay costs while the handle is dragged: a student at a time, 20 events a second."""

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from itertools import islice

import drag
import servers
from armlab.content.robots import catalogue
from armlab.session.pages import pages
from armlab.session.session import Session
from armlab.ui.plugin import panel, switches
from rounds import quantile, sized
from support.fake_browser import FakeBrowser

TITLE = "Dragging with a panel open, or an overlay on"
MOST = sized(None, 1)
"""How many panels, and how many overlays, are tried; None for all."""


def measure() -> Iterator[str]:
    yield "| open | p50 | p95 | processor time an event |"
    yield "| --- | --- | --- | --- |"
    points, angles = drag.script()
    with servers.lab() as server:
        for name, prepare in cases():
            reader = lambda browser: drag.by_first_joint(browser, angles)  # noqa: E731
            latencies, load = asyncio.run(drag.drive(server, 1, points, reader, prepare))
            p50, p95 = (1e3 * quantile(latencies, part) for part in (0.5, 0.95))
            yield f"| {name} | {p50:.1f} ms | {p95:.1f} ms | {1e3 * load / drag.RATE:.2f} ms |"


def cases() -> Iterator[tuple[str, Callable[[FakeBrowser], Awaitable[None]]]]:
    """Yield every panel beside which the arm is seen, then every switch of the picture that is off at first."""
    for key, page in islice(pages().items(), MOST):
        if not hides_arm(key):
            yield page.title, lambda browser, key=key: browser.open(key)
    for switch in islice((switch for switch in switches() if not switch.default), MOST):
        yield f"overlay: {switch.title}", lambda browser, name=switch.name: _switch_on(browser, name)


def hides_arm(key: str) -> bool:
    """Return whether a page, as it is first opened, shows something else in place of the arm."""
    found = panel(key)
    return "arm" in (*found.hides, *found.hides_then(Session.fresh("x", catalogue()["puma560"]).state))


async def _switch_on(browser: FakeBrowser, name: str) -> None:
    await browser.open("picture")
    await browser.press(name)
    await asyncio.sleep(0.2)
    await browser.open("joints")
