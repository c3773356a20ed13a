"""What students who have gone leave behind in the memory of the lab."""

import asyncio
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import numpy as np

import drag
import servers
from rounds import sized
from support.fake_browser import FakeBrowser, cookie_of

TITLE = "Memory of the lab after students have come and gone"
WARM, COMINGS, RETURNS, IDLE = sized((300, 300, 2_000, 200), (2, 2, 2, 2))
STUDENTS = sized(10, 2)
"""Browsers that come again and again: what is kept of 200 students who have gone is no leak."""

GONE = sized(3.0, 0.1)
"""Seconds until the pages of those who have gone are taken down."""

EACH = 5
"""Pages of one browser that are open at a time."""

ALLOCATORS = {"malloc": "C's", "pymalloc": "Python's own"}
"""Values of PYTHONMALLOC, and the allocator of memory that each stands for.

Python's own gives back whole megabytes only, in which nothing is left, C's pages of 4 kB: both keep more than is held,
which is counted in blocks of Python's own.
"""

LAB = """
import ctypes, gc, sys
sys.path[:0] = {paths!r}
from support.lab import open_lab
lab = open_lab(None, "puma560")
print(lab.port, flush=True)
for _ in sys.stdin:
    gc.collect()
    if sys.platform == "linux":
        ctypes.CDLL(None).malloc_trim(0)
    print(sys.getallocatedblocks(), flush=True)
lab.stop()
"""


class Lab:
    """A lab that gives back what memory it can before its memory is looked at."""

    def __init__(self, process: subprocess.Popen) -> None:
        self._process = process
        self.url = f"http://127.0.0.1:{int(process.stdout.readline())}/"
        self._server = servers.Server(self.url, (process.pid,))

    def tidied(self) -> tuple[float, float]:
        """Return its memory in megabytes, and how many million blocks of it Python holds in its own allocator."""
        print("tidy up", file=self._process.stdin, flush=True)
        blocks = int(self._process.stdout.readline())
        return self._server.memory() / 1e6, blocks / 1e6


@contextmanager
def lab(allocator: str) -> Iterator[Lab]:
    paths = [str(servers.HERE.parent / "app"), str(servers.HERE.parent / "tests")]
    process = subprocess.Popen(
        [sys.executable, "-c", LAB.format(paths=paths)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONMALLOC": allocator},
    )
    try:
        yield Lab(process)
    finally:
        process.communicate(timeout=60.0)


def measure() -> Iterator[str]:
    yield f"Once garbage is collected and free memory given back; in brackets its part of that after the first {WARM}."
    yield ""
    heads = [*(f"memory, {name} allocator" for name in ALLOCATORS.values()), "blocks that are held"]
    yield "| what has happened | " + " | ".join(heads) + " |"
    yield "| --- |" + " --- |" * len(heads)
    points, _ = drag.script()
    with ExitStack() as opened:
        labs = [opened.enter_context(lab(allocator)) for allocator in ALLOCATORS]
        cookies = [[cookie_of(each.url) for _ in range(STUDENTS)] for each in labs]
        yield f"| nobody has come yet | {' | '.join(_shown(_found(labs)))} |"
        bases: list[float] = []
        for said, story in (
            (f"{WARM} students have come, dragged and gone", lambda url, known: come(url, known, WARM, points)),
            (f"{COMINGS} more", lambda url, known: come(url, known, COMINGS, points)),
            (f"{RETURNS} times a page was loaded again", lambda url, known: come(url, known, RETURNS, points[:0])),
            (f"{IDLE} pages of {-(-IDLE // EACH)} new students were open together", lambda url, _: idle(url)),
            (f"{IDLE} pages of others after them", lambda url, _: idle(url)),
        ):
            for each, known in zip(labs, cookies, strict=True):
                asyncio.run(story(each.url, known))
            time.sleep(GONE)
            found = _found(labs)
            bases = bases or found
            shown = (f"{text} ({now / base:.2f})" for text, now, base in zip(_shown(found), found, bases, strict=True))
            yield f"| {said} | {' | '.join(shown)} |"


def _found(labs: list[Lab]) -> list[float]:
    """Return the memory of each lab, and the blocks that are held in the last, which has Python's own allocator."""
    found = [each.tidied() for each in labs]
    return [*(memory for memory, _ in found), found[-1][1]]


def _shown(found: list[float]) -> list[str]:
    *memory, blocks = found
    return [*(f"{each:.0f} MB" for each in memory), f"{blocks:.2f} million"]


async def come(url: str, cookies: list[str], count: int, points: np.ndarray) -> None:
    """Come so many times, several at once, drag if there are points to drag to, and go."""

    async def one(cookie: str, times: int) -> None:
        for _ in range(times):
            browser = FakeBrowser(url, cookie)
            await browser.connect()
            await browser.until(lambda browser=browser: drag.is_open(browser))
            if len(points):
                await browser.drag("start")
                for point in points[::20]:
                    await browser.drag("update", point, (1.0, 0.0, 0.0, 0.0))
                await browser.drag("end")
            await browser.close()

    await asyncio.gather(*(one(cookie, -(-count // len(cookies))) for cookie in cookies))


async def idle(url: str) -> None:
    """Open many pages, and close them when all are there."""
    cookies = [cookie_of(url) for _ in range(-(-IDLE // EACH))]
    browsers = [FakeBrowser(url, cookies[k // EACH]) for k in range(IDLE)]
    for browser in browsers:
        await browser.connect()
    for browser in browsers:
        await browser.until(lambda browser=browser: drag.is_open(browser))
    await asyncio.gather(*(browser.close() for browser in browsers))
