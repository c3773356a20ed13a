"""From the command to a page that can be used, and from a fresh clone."""

import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Browser, ViewportSize

from rounds import sized
from support.chromium import chromium

TITLE = "Start"
ROOT = Path(__file__).resolve().parents[1]
ROUNDS = sized(5, 1)
IS_CLONED = sized(True, False)
"""Whether it is also installed from a fresh clone, for which packages are downloaded."""

WINDOW: ViewportSize = {"width": 640, "height": 420}


def measure() -> Iterator[str]:
    yield "| what | seconds |"
    yield "| --- | --- |"
    lab = ["-P", "-m", "armlab", "--no-browser", "--port", "0", "--state"]
    ours, bare = Times([], [], []), Times([], [], [])
    with chromium() as browser:
        for _ in range(ROUNDS):
            with tempfile.TemporaryDirectory() as folder:
                opened(browser, [sys.executable, *lab, folder], ours, f"{NODES} && {PANEL}")
            opened(browser, [sys.executable, str(ROOT / "benchmarks" / "bare_server.py")], bare, NODES)
    yield f"| `armlab` → page served | {statistics.median(ours.served):.2f} |"
    yield f"| `armlab` → arm, handle and panels on the page | {statistics.median(ours.usable):.2f} |"
    yield f"| `armlab` → first picture complete, software GL | {statistics.median(ours.drawn):.2f} |"
    yield f"| a bare viser server → page served | {statistics.median(bare.served):.2f} |"
    yield f"| a bare viser server: its nodes on the page | {statistics.median(bare.usable):.2f} |"
    yield f"| a bare viser server: first picture complete, software GL | {statistics.median(bare.drawn):.2f} |"
    if IS_CLONED:
        yield from from_a_clone()


PATIENCE = 120.0
"""Longest time, in seconds, that a page may take for one of the moments: beside other work a picture takes long."""


@dataclass(frozen=True)
class Times:
    """Seconds from the command to three moments, one entry a round."""

    served: list[float]
    usable: list[float]
    drawn: list[float]


def opened(browser: Browser, command: list[str], times: Times, is_there: str) -> None:
    """Start a server, open its page as a new visitor, and note the times until all of it is there."""
    start = time.perf_counter()
    with printed_address(command) as url, browser.new_context() as context:
        times.served.append(time.perf_counter() - start)
        page = context.new_page()
        page.set_default_timeout(1e3 * PATIENCE)
        page.set_viewport_size(WINDOW)
        page.goto(url, wait_until="commit")
        page.wait_for_function(f"() => {is_there}", polling=20)
        times.usable.append(time.perf_counter() - start)
        page.screenshot()
        times.drawn.append(time.perf_counter() - start)


NODES = """['/target', '/body'].every(ending =>
  Object.keys(window.__viserMutable?.nodeRefFromName ?? {}).some(name => name.endsWith(ending)))"""
"""Whether handle and arm are in the scene."""

PANEL = "document.querySelector('[role=slider]') !== null"
"""Whether the panel of the joints is there."""


def from_a_clone() -> Iterator[str]:
    """Time the two commands of the README in a fresh clone with an empty home."""
    with tempfile.TemporaryDirectory() as folder:
        clone, home = Path(folder, "armlab"), Path(folder, "home")
        home.mkdir()
        subprocess.run(["git", "clone", "-q", str(ROOT), str(clone)], check=True)
        settings = {**os.environ, "HOME": str(home), "XDG_STATE_HOME": str(home)}
        for what in ("fresh clone: `python3 app` → address printed (installs)", "the same again"):
            start = time.perf_counter()
            with printed_address(["python3", "app", "--no-browser", "--port", "0"], cwd=clone, env=settings):
                yield f"| {what} | {time.perf_counter() - start:.2f} |"


@contextmanager
def printed_address(command: list[str], **options) -> Iterator[str]:
    """Start a lab and return what it prints as its address."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, **options)
    try:
        line = process.stdout.readline()
        yield re.search(r"http://\S+", line)[0] if "http" in line else f"http://127.0.0.1:{int(line)}/"
    finally:
        process.terminate()
        process.wait(60.0)  # beside load it takes its time
