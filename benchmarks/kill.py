"""What kill -9 costs a student: of a lab, of the front, of both, in the middle of moving a slider."""

import asyncio
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from rounds import sized
from support.fake_browser import FakeBrowser, cookie_of
from support.student import student

TITLE = "Killed in the middle: what a student loses"
ROUNDS = sized(30, 1)
SEED = 9
RATE = 20.0
"""Values of the slider a second."""

LEAST, MOST = sized(0.5, 0.1), sized(3.0, 0.5)
"""Seconds of moving before the kill."""

KINDS = sized(("lab", "front", "both"), ("both",))
BACK = 60.0
"""Seconds within which everything has to be there again."""


def measure() -> Iterator[str]:
    yield "| killed | times | arm found again | most lost | until the arm is back, median |"
    yield "| --- | --- | --- | --- | --- |"
    rng = np.random.default_rng(SEED)
    lost: dict[str, list[float]] = {kind: [] for kind in KINDS}
    back: dict[str, list[float]] = {kind: [] for kind in KINDS}
    with tempfile.TemporaryDirectory() as folder, Class(Path(folder)) as lab:
        cookie = cookie_of(lab.url)
        for k in range(ROUNDS):
            kind = KINDS[k % len(KINDS)]
            seconds, wait = asyncio.run(one(lab, cookie, kind, float(rng.uniform(LEAST, MOST)), k))
            lost[kind].append(seconds)
            back[kind].append(wait)
    for kind in KINDS:
        found = f"{sum(map(np.isfinite, lost[kind]))} of {len(lost[kind])}"
        times = f"{max(lost[kind]):.2f} s | {np.median(back[kind]):.1f} s"
        yield f"| {kind} | {len(lost[kind])} | {found} | {times} |"


class Class:
    """A front with one lab, which can be killed and started again on its port."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        with socket.create_server(("127.0.0.1", 0)) as free:
            self._port = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self._port}/"

    def __enter__(self) -> "Class":
        self.start()
        return self

    def start(self) -> None:
        command = [sys.executable, "-m", "armlab", "--no-browser", "--labs", "1"]
        self._front = subprocess.Popen(
            [*command, "--port", str(self._port), "--state", str(self._folder)],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        assert "open" in self._front.stdout.readline()

    def kill(self, kind: str) -> None:
        """Kill -9; a front that was killed is started again at once."""
        labs = [pid for pid in _descendants(self._front.pid) if _is_lab(pid)]
        if kind != "front":
            for pid in labs:
                os.kill(pid, signal.SIGKILL)
        if kind != "lab":
            self._front.kill()
            self._front.communicate()
            self.start()

    def __exit__(self, *_: object) -> None:
        self._front.terminate()
        self._front.communicate(timeout=20.0)


def _descendants(pid: int) -> list[int]:
    found = []
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += [int(child), *_descendants(int(child))]
    return found


def _is_lab(pid: int) -> bool:
    return b"lab_process" in Path(f"/proc/{pid}/cmdline").read_bytes()


async def one(lab: Class, cookie: str, kind: str, seconds: float, number: int) -> tuple[float, float]:
    """Move a slider, kill, come back; return the seconds of work that are lost and those until the arm was there."""
    browser = await student(lab.url, cookie)
    sent: list[tuple[float, float]] = [(browser.slider(1)["value"], time.monotonic())]
    while time.monotonic() - sent[0][1] < seconds:
        value = round(-60.0 + 7.0 * (number % 15) + 0.1 * len(sent), 1)
        await browser.set_value(browser.slider(1), value)
        sent.append((value, time.monotonic()))
        await asyncio.sleep(1.0 / RATE)
    killed = time.monotonic()
    await asyncio.to_thread(lab.kill, kind)
    await browser.close()
    again = await _come_back(lab, cookie)
    found = again.slider(1)["value"]
    waited = time.monotonic() - killed
    await again.close()
    times = [at for value, at in sent if abs(value - found) < 0.01]
    return (killed - times[-1] if times else float("inf")), waited


async def _come_back(lab: Class, cookie: str) -> FakeBrowser:
    end = time.monotonic() + BACK
    while True:
        try:
            return await student(lab.url, cookie)
        except Exception:
            if time.monotonic() > end:
                raise
            await asyncio.sleep(0.1)
