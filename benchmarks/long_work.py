"""Ten students have long work done at once while one drags."""

import asyncio
from collections.abc import Iterator

import numpy as np

import drag
import servers
from rounds import quantile, sized
from support.fake_browser import FakeBrowser

TITLE = "Long work of ten students while one drags: handle event to new pose"
WORKERS, ROUNDS = sized((10, 3), (1, 1))
WORK = {"workspace": "sample", "section": "", "dexterous": "", "basins": "draw"}
"""Benches, and what is pressed there for the work to begin; that of the others begins when they are looked at."""


def measure() -> Iterator[str]:
    yield "| the others | p50 | p95 | processor time |"
    yield "| --- | --- | --- | --- |"
    points, angles = drag.script()
    found: dict[str, tuple[list[float], list[float]]] = {"look on": ([], []), "have long work done": ([], [])}
    for _ in range(ROUNDS):
        for name, (latencies, loads) in found.items():
            with servers.lab() as server:
                times, load = asyncio.run(story(server, points, angles, name != "look on"))
            latencies += times
            loads.append(load)
    for name, (latencies, loads) in found.items():
        p50, p95 = (f"{quantile(latencies, part) * 1e3:.1f} ms" for part in (0.5, 0.95))
        yield f"| {name} | {p50} | {p95} | {100 * np.median(loads):.0f} % |"


async def story(
    server: servers.Server, points: np.ndarray, angles: np.ndarray, working: bool
) -> tuple[list[float], float]:
    """Return what one drag costs beside the others."""
    student = server.browser()
    others = [server.browser() for _ in range(WORKERS)]
    for browser in (student, *others):
        await browser.connect()
        await browser.until(lambda browser=browser: drag.is_open(browser))
    if working:
        await asyncio.gather(*(begin(browser, k) for k, browser in enumerate(others)))
    before, start = server.cpu(), asyncio.get_running_loop().time()
    latencies = await drag.one_student(student, points, drag.by_first_joint(student, angles), 0.0)
    load = (server.cpu() - before) / (asyncio.get_running_loop().time() - start)
    await asyncio.gather(*(browser.close() for browser in (student, *others)))
    return latencies, load


async def begin(browser: FakeBrowser, number: int) -> None:
    """Open the bench of this student and have its work begun."""
    bench, pressed = list(WORK.items())[number % len(WORK)]
    await browser.open(bench)
    if pressed:
        await browser.press(pressed)
