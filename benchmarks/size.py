"""What a student costs: memory, the work of opening a page; and the size of the wheel."""

import asyncio
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import servers
from drag import SETTLING, is_open
from rounds import sized
from support.fake_browser import FakeBrowser

TITLE = "Cost of a student, size of the wheel"
ROOT = Path(__file__).resolve().parents[1]
FIRST, MORE = sized((10, 30), (1, 2))


def measure() -> Iterator[str]:
    yield "| what | figure |"
    yield "| --- | --- |"
    with servers.lab() as server:
        memory, seconds, received = asyncio.run(opened(server))
    yield f"| memory of one more idle student | {memory / 1e6:.1f} MB |"
    yield f"| processor time of the server to open a page | {seconds * 1e3:.0f} ms |"
    yield f"| sent to a page when it opens, after the page itself | {received / 1e3:.0f} kB |"
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", folder, str(ROOT)]
        subprocess.run(command, check=True, capture_output=True)
        (wheel,) = Path(folder).glob("*.whl")
        yield f"| wheel | {wheel.stat().st_size / 1e6:.2f} MB |"


async def opened(server: servers.Server) -> tuple[float, float, float]:
    """Return bytes, seconds and bytes sent for each student after the first ones."""
    browsers = [await one_more(server) for _ in range(FIRST)]
    await asyncio.sleep(SETTLING)
    memory, cpu = server.memory(), server.cpu()
    browsers += [await one_more(server) for _ in range(MORE)]
    await asyncio.sleep(SETTLING)
    used, spent = server.memory() - memory, server.cpu() - cpu
    received = sum(browser.bytes for browser in browsers[FIRST:])
    await asyncio.gather(*(browser.close() for browser in browsers))
    return used / MORE, spent / MORE, received / MORE


async def one_more(server: servers.Server) -> FakeBrowser:
    """Open a page."""
    browser = server.browser()
    await browser.connect()
    await browser.until(lambda: is_open(browser))
    return browser
