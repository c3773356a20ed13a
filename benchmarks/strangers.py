"""Strangers in a process of their own: what they make of their frames must not hold up the student who is watched.

``python strangers.py URL FRAMES REQUESTS STRANGERS`` prints how many frames were sent and how many requests answered.
"""

import asyncio
import contextlib
import http.client
import json
import os
import re
import sys
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / folder) for folder in ("app", "tests")]

import msgspec  # noqa: E402
import numpy as np  # noqa: E402
from websockets.exceptions import WebSocketException  # noqa: E402

from armlab.session.pages import pages  # noqa: E402
from support.fake_browser import CAMERA, FakeBrowser, cookie_of  # noqa: E402
from support.student import is_open  # noqa: E402

SEED = 13
TOGETHER = 40
"""Frames a stranger sends before anything else gets its turn."""

RATE = 100.0
"""Frames a second, a little fewer than are slowed down: who sends more is cut off, and does not send for a minute."""

OPENING = 3.0
"""Seconds a stranger waits for a page: what was typed may have led to a lesson that hides it."""

THROWN_OUT = (OSError, TimeoutError, WebSocketException)
"""What a stranger meets who is thrown out, or refused for a while: that is what is tried."""

NICENESS = 10
"""Of strangers: the processor time they need is that of other machines."""

ENDING = 0.002
"""Part of the frames at which viser hangs up: no message at all, or a value of another type than its field. More of
them, and what a stranger sends behind one would never be read."""

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


class Stranger:
    """A browser that sends what comes to its mind, and opens another socket when it is thrown out."""

    def __init__(self, url: str, rng: np.random.Generator) -> None:
        self._url, self._rng, self.sent = url, rng, 0
        self._browser: FakeBrowser | None = None
        self._cells: list[tuple[str, str]] = []

    async def flood(self, count: int) -> None:
        while self.sent < count:
            with contextlib.suppress(*THROWN_OUT):
                await self._one_socket(count)
            if self._browser is not None:
                with contextlib.suppress(*THROWN_OUT):
                    await self._browser.close()
            await asyncio.sleep(0.2)

    async def _one_socket(self, count: int) -> None:
        # Each time as somebody new: who was thrown out has to wait for a minute.
        self._browser = browser = FakeBrowser(self._url, cookie_of(self._url))
        await browser.connect()
        # As long as it takes: strangers that came again and again to a lab that is slow would send nothing at all.
        await browser.until(lambda: is_open(browser) or browser.close_code is not None)
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(browser.open(str(self._rng.choice(list(pages())))), OPENING)
        while self.sent < count and browser.close_code is None:
            self._cells = re.findall(r'data-chan="([^"]*)"[^>]*data-cell="([^"]*)"', browser.html())
            for _ in range(TOGETHER):
                frame = self._frame(browser)
                self.sent += 1
                await browser.send_raw(frame)
            await asyncio.sleep(TOGETHER / RATE)

    def _frame(self, browser: FakeBrowser) -> bytes:
        if self._rng.random() < ENDING:
            return self._ending(browser)
        kind = self._rng.choice(4, p=(0.5, 0.3, 0.15, 0.05))
        if kind == 0:
            return self._filled_field()
        if kind == 1:
            return self._damaged_message(browser)
        return self._value(browser) if kind == 2 else msgspec.msgpack.encode(CAMERA)

    def _ending(self, browser: FakeBrowser) -> bytes:
        """Return a part of a message, any bytes, or a message with a value of another type in one of its fields."""
        whole = msgspec.msgpack.encode(CAMERA)
        kind = self._rng.integers(3)
        if kind == 0:
            return whole[: self._rng.integers(1, len(whole))]
        if kind == 1:
            return self._rng.bytes(int(self._rng.integers(1, 200)))
        message = self._message(browser)
        junk = [None, "x", [], {"a": 1}, [[1, 2], [3]], True]
        message[self._field_of(message)] = junk[self._rng.integers(len(junk))]
        return msgspec.msgpack.encode(message)

    def _filled_field(self) -> bytes:
        """Fill a field, or press a button, that is on the page; or one that is not."""
        chan, cell = self._cells[self._rng.integers(len(self._cells))] if self._cells else ("x", "y")
        if self._rng.random() < 0.2:
            cell = str(self._rng.choice(["", "0,0", "99,99", "remove,9999", "-1", "q7", "x" * 1000]))
        text = TEXTS[self._rng.integers(len(TEXTS))]
        value = msgspec.json.encode([cell, text.encode("utf-8", "replace").decode(), 1]).decode()
        return msgspec.msgpack.encode({"type": "GuiUpdateMessage", "uuid": chan, "updates": {"value": value}})

    def _damaged_message(self, browser: FakeBrowser) -> bytes:
        """Take an honest message and put numbers into one of its fields that nobody can work with."""
        message = self._message(browser)
        field = self._field_of(message)
        numbers = self._rng.choice((0.0, -1.0, 1e308, -1e308, 1e-308, 1e18, np.nan, np.inf), size=4).tolist()
        old = message[field]
        if isinstance(old, str):
            message[field] = str(self._rng.choice(["", "x" * 5_000, "/", "/0/1/2", "-1"]))
        elif isinstance(old, int):
            message[field] = (0, -1, 10**18)[self._rng.integers(3)]
        else:
            message[field] = numbers[: len(old)] if isinstance(old, tuple) else numbers[0]
        return msgspec.msgpack.encode(message)

    def _message(self, browser: FakeBrowser) -> dict[str, Any]:
        """Return what a page says when its camera, or something in its scene, was moved."""
        name = str(self._rng.choice(sorted(browser.nodes)))
        handle = {"name": name, "owner": browser.owner, "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (0.1, 0.2, 0.3)}
        return dict([CAMERA, {"type": "TransformControlsUpdateMessage", **handle}][self._rng.integers(2)])

    def _field_of(self, message: dict[str, Any]) -> str:
        return str(self._rng.choice([key for key in message if key != "type"]))

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
        except (OSError, http.client.HTTPException):
            continue  # a visitor who is slow is hung up on
    return answered


async def flood(url: str, frames: int, count: int) -> int:
    """Let so many strangers send so many frames together; return how many were sent."""
    strangers = [Stranger(url, np.random.default_rng([SEED, k])) for k in range(count)]
    await asyncio.gather(*(stranger.flood(frames // count) for stranger in strangers))
    return sum(stranger.sent for stranger in strangers)


def main(url: str, frames: str, requests: str, count: str) -> None:
    os.nice(NICENESS)
    with ThreadPoolExecutor() as own:
        asked = own.submit(ask, url, np.random.default_rng(SEED), int(requests))
        sent = asyncio.run(flood(url, int(frames), int(count)))
    print(json.dumps([sent, asked.result()]))


if __name__ == "__main__":
    main(*sys.argv[1:])
