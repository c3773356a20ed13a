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
from pathlib import Path

from support.page import SMALL, chromium

TITLE = "Start"
ROOT = Path(__file__).resolve().parents[1]
ROUNDS = 5


def measure() -> Iterator[str]:
    yield "| what | seconds |"
    yield "| --- | --- |"
    served, usable = [], []
    with chromium() as browser:
        for _ in range(ROUNDS):
            with tempfile.TemporaryDirectory() as folder, browser.new_context() as context:
                command = [sys.executable, "-P", "-m", "armlab", "--no-browser", "--port", "0", "--state", folder]
                start = time.perf_counter()
                with printed_address(command) as url:
                    served.append(time.perf_counter() - start)
                    page = context.new_page()
                    page.set_viewport_size({"width": SMALL[0], "height": SMALL[1]})
                    page.goto(url, wait_until="commit")
                    wait_for_arm(page)
                    usable.append(time.perf_counter() - start)
    yield f"| `armlab` → address printed, page served | {statistics.median(served):.2f} |"
    yield f"| `armlab` → arm and handle drawn in Chromium (software GL) | {statistics.median(usable):.2f} |"
    yield from from_a_clone()


def wait_for_arm(page) -> None:
    """Wait until the arm and its handle are in the scene and one frame was drawn."""
    page.wait_for_function(
        """() => {
          const nodes = window.__viserMutable?.nodeRefFromName ?? {};
          return nodes['/target'] && Object.keys(nodes).some(name => name.endsWith('/body'));
        }""",
        polling=20,
        timeout=60_000,
    )
    page.evaluate("() => new Promise(drawn => requestAnimationFrame(drawn))")


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
        yield re.search(r"http://\S+", process.stdout.readline())[0]
    finally:
        process.terminate()
        process.wait(10.0)
