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

import drag
import servers
from rounds import quantile, sized
from support.fake_browser import FakeBrowser

TITLE = "Strangers: random frames and requests beside a student who drags"
FRAMES = sized(100_000, 400)
REQUESTS = sized(10_000, 20)
STRANGERS = sized(4, 2)


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
    script = str(servers.HERE / "strangers.py")
    numbers = map(str, (FRAMES, REQUESTS, STRANGERS))
    strangers = await asyncio.create_subprocess_exec(
        sys.executable, script, server.url, *numbers, stdout=subprocess.PIPE
    )
    told = asyncio.create_task(strangers.communicate())
    beside: list[float] = []
    while not beside or not told.done():
        beside += await drag.one_student(student, points, reader, 0.0)
    sent, answered = json.loads((await told)[0])
    shown = student.slider(1)["value"]
    again = FakeBrowser(server.url, student.cookie)
    await again.connect()
    await again.until(lambda: drag.is_open(again))
    kept = "kept" if again.slider(1)["value"] == shown else "lost"
    await again.close()
    await student.close()
    return alone, beside, sent, answered, kept
