"""Frames and requests that no honest page sends, beside a student who drags."""

import asyncio
import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import drag
import servers
from rounds import TINY, quantile, sized
from support.fake_browser import FakeBrowser

TITLE = "Strangers: random frames and requests beside a student who drags"
FRAMES = sized(100_000, 400)
REQUESTS = sized(10_000, 20)
STRANGERS = sized(4, 2)


LABS = sized((0, drag.LABS), (0,))
"""Labs behind a front, for each server that is tried; none is one process without a front."""

Drags = tuple[list[float], list[float]]
"""Seconds from each event of the handle to its pose: of the clock, and of the server's processor time."""


def measure() -> Iterator[str]:
    yield "| server | frames | requests | all of it lives | tracebacks | lines of the log | student's arm | memory |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    found = {}
    for labs in LABS:
        name = f"front and {labs} labs" if labs else "one process"
        found[name], counted = tried(labs)
        yield f"| {name} | {counted} |"
    yield ""
    yield "| server | the student drags | p50 | p95 | ÷ alone | processor time of the server, p50 | p95 | ÷ alone |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    for name, drags in found.items():
        for beside, cells in compared(drags):
            yield f"| {name} | {beside} | {cells} |"


def tried(labs: int) -> tuple[dict[str, Drags], str]:
    """Let strangers loose on a server; return the student's times, and what was counted as cells of a table."""
    with tempfile.TemporaryFile("w+") as said, lab(said, labs) as server:
        drags, sent, requests, kept, memory = asyncio.run(story(server))
        alive = "yes" if all(Path(f"/proc/{pid}").exists() for pid in server.pids) else "no"
        said.seek(0)
        log = said.read()
    if os.environ.get("ARMLAB_FUZZ_LOG"):
        with Path(os.environ["ARMLAB_FUZZ_LOG"]).open("a") as kept_log:
            kept_log.write(log)
    traces, lines = log.count("Traceback"), len(log.splitlines())
    counted = f"{sent} | {requests} | {alive} | {traces} | {lines} | {kept}"
    return drags, f"{counted} | {memory[0] / 1e6:.0f} MB, then {memory[1] / 1e6:.0f} MB"


def compared(drags: dict[str, Drags]) -> Iterator[tuple[str, str]]:
    """Yield what the student had beside, and the times as cells of a table, compared to those of nobody beside."""
    alone = [quantile(drags["alone before"][k] + drags["alone after"][k], 0.95) for k in (0, 1)]
    for name, found in drags.items():
        cells = []
        for seconds, usual in zip(found, alone, strict=True):
            p50, p95 = quantile(seconds, 0.5), quantile(seconds, 0.95)
            cells += [f"{p50 * 1e3:.1f} ms", f"{p95 * 1e3:.1f} ms", f"{p95 / usual:.1f}"]
        yield name, " | ".join(cells)


@contextlib.contextmanager
def lab(said: IO[str], labs: int) -> Iterator[servers.Server]:
    """Run Armlab with its complaints in a file."""
    paths = [str(servers.HERE.parent / "app"), str(servers.HERE.parent / "tests")]
    process = subprocess.Popen(
        [sys.executable, "-c", servers.LAB.format(paths=paths, labs=labs, tiny=TINY)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=said,
        text=True,
    )
    try:
        port = int(process.stdout.readline())
        yield servers.Server(f"http://127.0.0.1:{port}/", (process.pid, *servers.children(process.pid)))
    finally:
        process.communicate(timeout=60.0)


async def story(server: servers.Server) -> tuple[dict[str, Drags], int, int, str, tuple[int, int]]:
    """Drag alone, beside strangers, and alone again: the machine may not be as quiet as it was.

    Before that the arm is brought to where the way begins, in half a second, and its formulas are compiled.

    Returns the times, what was sent, how much was answered, whether the arm is where it was, and the memory.
    """
    ways = drag.to_and_fro(*drag.script())
    student = server.browser()
    await student.connect()
    await student.until(lambda: drag.is_open(student))
    await asyncio.sleep(drag.SETTLING)
    drags: dict[str, Drags] = {name: ([], []) for name in ("", "alone before", "beside strangers", "alone after")}

    async def once(name: str) -> None:
        points, angles = next(ways)
        reader, (seconds, used) = drag.by_first_joint(student, angles), drags[name]
        seconds += await drag.one_student(student, points, reader, 0.0, server.used, used)

    await once("")
    del drags[""]
    await once("alone before")
    before = server.memory()
    script = str(servers.HERE / "strangers.py")
    numbers = map(str, (FRAMES, REQUESTS, STRANGERS))
    strangers = await asyncio.create_subprocess_exec(
        sys.executable, script, server.url, *numbers, stdout=subprocess.PIPE
    )
    told = asyncio.create_task(strangers.communicate())
    while not drags["beside strangers"][0] or not told.done():
        await once("beside strangers")
    sent, answered = json.loads((await told)[0])
    memory = before, server.memory()
    await once("alone after")
    shown = student.slider(1)["value"]
    again = FakeBrowser(server.url, student.cookie)
    await again.connect()
    await again.until(lambda: drag.is_open(again))
    kept = "kept" if again.slider(1)["value"] == shown else "lost"
    await again.close()
    await student.close()
    return drags, sent, answered, kept, memory
