"""The workspace at the page: how soon its first points come, and what sampling costs another student who drags."""

import asyncio
import time
from collections.abc import Iterator

import drag
import servers
from rounds import quantile, sized
from support.fake_browser import FakeBrowser, Message

TITLE = "Workspace at the page: first points, a changed link, and others who drag meanwhile"
ROUNDS = sized(7, 1)
COUNT, MANY = sized((100_000, 10_000_000), (26_000, 1_000_000))


def measure() -> Iterator[str]:
    with servers.lab() as server:
        first, whole = asyncio.run(clicked(server))
        yield "| from | to | p50 |"
        yield "| --- | --- | --- |"
        yield f"| a click on Sample | first points at the browser | {1e3 * quantile(first, 0.5):.0f} ms |"
        yield f"| a click on Sample | all of {COUNT:,} samples | {1e3 * quantile(whole, 0.5):.0f} ms |".replace(
            ",", " "
        )
        points, volume = asyncio.run(supposed(server))
        changed = "another link length, Compare designs"
        yield f"| {changed} | new points at the browser | {1e3 * quantile(points, 0.5):.0f} ms |"
        yield f"| {changed} | volume with its error | {1e3 * quantile(volume, 0.5):.0f} ms |"
        yield ""
        yield "| a student drags, another | p50 | p95 |"
        yield "| --- | --- | --- |"
        for name, sampling in (("rests", False), ("samples 10⁷ configurations, again and again", True)):
            latencies = asyncio.run(dragged(server, sampling))
            p50, p95 = (1e3 * quantile(latencies, part) for part in (0.5, 0.95))
            yield f"| {name} | {p50:.1f} ms | {p95:.1f} ms |"


async def opened(server: servers.Server, page: str) -> FakeBrowser:
    """Return a new student with a page open."""
    browser = server.browser()
    await browser.connect()
    await browser.until(lambda: drag.is_open(browser))
    await browser.open(page)
    return browser


async def clicked(server: servers.Server) -> tuple[list[float], list[float]]:
    """Return the seconds from clicks on Sample to the first points, and to all; every seed is another cloud."""
    first, whole = [], []
    for k in range(ROUNDS):
        browser = await opened(server, "workspace")
        await browser.press("count", f"count {COUNT}")
        await browser.press("seed", str(1000 + k))
        await asyncio.sleep(1.0)
        start = time.perf_counter()
        arrived = listening(browser)
        await browser.press("sample")
        await browser.until(lambda arrived=arrived: bool(arrived))
        first.append(arrived[0] - start)
        await browser.until(lambda b=browser: "Save PLY" in b.html() and 'data-cell="cancel"' not in b.html())
        whole.append(time.perf_counter() - start)
        await browser.close()
    return first, whole


async def supposed(server: servers.Server) -> tuple[list[float], list[float]]:
    """Return the seconds from a typed link length to points of the other arm, and to both volumes."""
    points, volume = [], []
    browser = await opened(server, "what_if")
    await browser.until(lambda: "±" in browser.html())
    for k in range(ROUNDS):
        await asyncio.sleep(0.5)
        start = time.perf_counter()
        arrived = listening(browser)
        await browser.press("value", str(500 + 10 * k))
        await browser.until(lambda arrived=arrived: bool(arrived))
        points.append(arrived[0] - start)
        changed = f"<b>{500 + 10 * k}.0 mm</b>"
        await browser.until(lambda changed=changed: changed in browser.html() and "known to" in browser.html())
        volume.append(time.perf_counter() - start)
    await browser.close()
    return points, volume


def listening(browser: FakeBrowser) -> list[float]:
    """Return a list that gets the times at which points arrive."""
    arrived: list[float] = []

    def note(message: Message, at: float) -> None:
        new = message["type"] == "PointCloudMessage"
        other = message["type"] == "SceneNodeUpdateMessage" and "points" in message["updates"]
        if new or other:
            arrived.append(at)

    browser.on_message = note
    return arrived


async def dragged(server: servers.Server, sampling: bool) -> list[float]:
    """Return the latencies of one student's drag, while another samples or only looks at the page."""
    points, angles = drag.script()
    other = await opened(server, "workspace")
    work = asyncio.create_task(sampled(other)) if sampling else None
    latencies, _ = await drag.drive(server, 1, points, lambda browser: drag.by_first_joint(browser, angles))
    if work is not None:
        work.cancel()
        await asyncio.gather(work, return_exceptions=True)
    await other.close()
    return latencies


async def sampled(browser: FakeBrowser) -> None:
    """Sample for ever, each time with another seed."""
    await browser.press("count", f"count {MANY}")
    for seed in range(1, 10_000):
        await browser.press("seed", str(seed))
        await browser.until(lambda: 'data-cell="sample"' in browser.html())
        await browser.press("sample")
        await browser.until(lambda: 'data-cell="cancel"' in browser.html())
        await browser.until(lambda: 'data-cell="sample"' in browser.html())


if __name__ == "__main__":
    print(*measure(), sep="\n")
