"""Frames and requests that no honest page sends, beside a student who drags."""

import asyncio
import contextlib
import os
import re
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np

import drag
import servers
from rounds import quantile, sized
from support.fake_browser import CAMERA, FakeBrowser, cookie_of

TITLE = "Strangers: random frames and requests beside a student who drags"
FRAMES = sized(20_000, 400)
REQUESTS = sized(1_000, 20)
STRANGERS = sized(20, 2)
SEED = 13
TOGETHER = 40
"""Frames a stranger sends before anything else gets its turn."""

BENCHES = ("table", "motion", "solutions", "iterate", "section", "lessons")
"""Benches that strangers have open: their fields are filled at random."""

TEXTS = (
    "9" * 400_000,
    "-" + "9" * 5_000,
    "1e400",
    "nan",
    "9**9**9**9",
    "(" * 5_000,
    "[" * 100_000,
    "<script>alert(1)</script><img src=x onerror=alert(1)>",
    "\\href{javascript:alert(1)}{x}",
    "\u202e\u0000\ud800",
    "../../etc/passwd",
    "time_s,q1_rad\n" + "0,0\n" * 30_000,
    '{"format": "armlab-plan", "version": 1, "robot": {}, "plan": {}}',
    "",
    "0.2 m",
    "pi/3",
)
PATHS = ("..%2f..%2fetc%2fpasswd", "robot/%00", "lesson/" + "x" * 5_000, "state/%ff%fe", "?websocket=ws://evil", "//x")


def measure() -> Iterator[str]:
    yield "| frames | requests | lab lives | tracebacks | lines of the log | p95 ÷ p95 alone | student's arm |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    with tempfile.TemporaryFile("w+") as said, lab(said) as server:
        alone, beside, sent, requests, kept = asyncio.run(story(server))
        alive = Path(f"/proc/{server.pids[0]}").exists()
        said.seek(0)
        log = said.read()
    ratio = quantile(beside, 0.95) / quantile(alone, 0.95)
    traces, lines = log.count("Traceback"), len(log.splitlines())
    yield f"| {sent} | {requests} | {'yes' if alive else 'no'} | {traces} | {lines} | {ratio:.1f} | {kept} |"
    if os.environ.get("ARMLAB_FUZZ_LOG"):
        Path(os.environ["ARMLAB_FUZZ_LOG"]).write_text(log)


@contextlib.contextmanager
def lab(said) -> Iterator[servers.Server]:
    """Run Armlab with its complaints in a file."""
    paths = [str(servers.HERE.parent / "app"), str(servers.HERE.parent / "tests")]
    process = subprocess.Popen(
        [sys.executable, "-c", servers.LAB.format(paths=paths, labs=0)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=said,
        text=True,
    )
    try:
        yield servers.Server(f"http://127.0.0.1:{int(process.stdout.readline())}/", (process.pid,))
    finally:
        process.communicate(timeout=60.0)


async def story(server: servers.Server) -> tuple[list[float], list[float], int, int, str]:
    """Drag alone, then beside strangers; return both latencies, what was sent, and whether the arm is where it was."""
    points, angles = drag.script()
    student = server.browser()
    await student.connect()
    await student.until(lambda: drag.is_open(student))
    await asyncio.sleep(drag.SETTLING)
    reader = drag.by_first_joint(student, angles)
    alone = await drag.one_student(student, points, reader, 0.0)
    rng = np.random.default_rng(SEED)
    strangers = [Stranger(server.url, np.random.default_rng([SEED, k])) for k in range(STRANGERS)]
    flooding = asyncio.gather(*(stranger.flood(FRAMES // STRANGERS) for stranger in strangers))
    asking = asyncio.to_thread(ask, server.url, rng, REQUESTS)
    asked = asyncio.create_task(asking)
    beside: list[float] = []
    while not beside or not (flooding.done() and asked.done()):
        beside += await drag.one_student(student, points, reader, 0.0)
    await flooding
    await student.until(lambda: True)
    shown = student.slider(1)["value"]
    again = FakeBrowser(server.url, student.cookie)
    await again.connect()
    await again.until(lambda: drag.is_open(again))
    kept = "kept" if again.slider(1)["value"] == shown else "lost"
    await again.close()
    await student.close()
    return alone, beside, sum(stranger.sent for stranger in strangers), await asked, kept


class Stranger:
    """A browser that sends what comes to its mind, and opens another socket when it is thrown out."""

    def __init__(self, url: str, rng: np.random.Generator) -> None:
        self._url, self._rng, self.sent = url, rng, 0
        self._browser: FakeBrowser | None = None
        self.ends: Counter[object] = Counter()

    async def flood(self, count: int) -> None:
        cookie = cookie_of(self._url)
        while self.sent < count:
            with contextlib.suppress(Exception):  # thrown out, or refused for a while: that is what is tried
                await self._one_socket(cookie, count)
            if self._browser is not None:
                self.ends[self._browser.close_code] += 1
                with contextlib.suppress(Exception):
                    await self._browser.close()
            await asyncio.sleep(0.2)

    async def _one_socket(self, cookie: str, count: int) -> None:
        self._browser = browser = FakeBrowser(self._url, cookie)
        await browser.connect()
        await browser.until(lambda: drag.is_open(browser))
        await browser.open(str(self._rng.choice(BENCHES)))
        while self.sent < count and browser.close_code is None:
            for _ in range(TOGETHER):
                frame = self._frame(browser)
                self.sent += 1
                await browser.send_raw(frame)
            await asyncio.sleep(0)

    def _frame(self, browser: FakeBrowser) -> bytes:
        kind = self._rng.choice(5, p=(0.5, 0.3, 0.15, 0.045, 0.005))
        if kind == 0:
            return self._filled_field(browser)
        if kind == 1:
            return self._damaged_message(browser)
        if kind == 2:
            return self._value(browser)
        whole = msgspec.msgpack.encode(CAMERA)
        if kind == 3:
            return whole[: self._rng.integers(1, len(whole))] if self._rng.random() < 0.1 else whole
        return self._rng.bytes(int(self._rng.integers(1, 200)))

    def _filled_field(self, browser: FakeBrowser) -> bytes:
        """Fill a field, or press a button, that is on the page; or one that is not."""
        cells = re.findall(r'data-chan="([^"]*)"[^>]*data-cell="([^"]*)"', browser.html())
        chan, cell = cells[self._rng.integers(len(cells))] if cells else ("x", "y")
        if self._rng.random() < 0.2:
            cell = str(self._rng.choice(["", "0,0", "99,99", "remove,9999", "-1", "q7", "x" * 1000]))
        text = TEXTS[self._rng.integers(len(TEXTS))]
        value = msgspec.json.encode([cell, text.encode("utf-8", "replace").decode(), 1]).decode()
        return msgspec.msgpack.encode({"type": "GuiUpdateMessage", "uuid": chan, "updates": {"value": value}})

    def _damaged_message(self, browser: FakeBrowser) -> bytes:
        """Take an honest message and put something else into one of its fields."""
        name = str(self._rng.choice(sorted(browser.nodes)))
        handle = {"name": name, "owner": browser.owner, "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (0.1, 0.2, 0.3)}
        message = [CAMERA, {"type": "TransformControlsUpdateMessage", **handle}][self._rng.integers(2)]
        message = dict(message)
        field = str(self._rng.choice([key for key in message if key != "type"]))
        junk = [None, "x", [], [1e308] * 3, [0.0] * 4, float("nan"), 10**18, {"a": 1}, [[1, 2], [3]], True]
        message[field] = junk[self._rng.integers(len(junk))]
        return msgspec.msgpack.encode(message)

    def _value(self, browser: FakeBrowser) -> bytes:
        """Give a control some value."""
        uuids = sorted(browser.controls)
        uuid = uuids[self._rng.integers(len(uuids))]
        junk = [1e308, -1e-308, "9" * 5000, None, [], True, [1, 2, 3], {"x": 1}, 10**18]
        updates = {"value": junk[self._rng.integers(len(junk))]}
        if self._rng.random() < 0.2:
            updates = {str(self._rng.choice(["props", "removed", "update_cb"])): 1}
        return msgspec.msgpack.encode({"type": "GuiUpdateMessage", "uuid": uuid, "updates": updates})


def ask(url: str, rng: np.random.Generator, count: int) -> int:
    """Ask for pages that are not there; returns how many were answered."""
    answered = 0
    for _ in range(count):
        path = PATHS[rng.integers(len(PATHS))]
        headers = {"Cookie": "armlab=" + "x" * int(rng.integers(2000))} if rng.random() < 0.5 else {}
        try:
            with urllib.request.urlopen(urllib.request.Request(url + path, headers=headers), timeout=30.0):
                answered += 1
        except urllib.error.HTTPError:
            answered += 1
        time.sleep(0.002)
    return answered
