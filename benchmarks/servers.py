"""Servers in processes of their own, and what they cost."""

import atexit
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from rounds import TINY
from support.fake_browser import FakeBrowser, cookie_of

HERE = Path(__file__).resolve().parent
LAB = """
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
sys.path[:0] = {paths!r}
from armlab.ui.plugin import panels
from support.lab import open_lab
with TemporaryDirectory() as folder:
    lab = open_lab(Path(folder), "puma560", {labs})
    if lab.lab is not None and not {tiny}:
        panels()  # as the command does when its first page is open
    print(lab.port, flush=True)
    sys.stdin.read()
    lab.stop()
"""
"""A lab that saves what its students do, as the command does."""


@dataclass(frozen=True)
class Server:
    """A server and its processes."""

    url: str
    pids: tuple[int, ...]
    has_front: bool = True

    def browser(self) -> FakeBrowser:
        """Return a browser of a new student."""
        return FakeBrowser(self.url, cookie_of(self.url) if self.has_front else None)

    def cpu(self) -> float:
        """Return the seconds of processor time used so far."""
        fields = [Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split() for pid in self.pids]
        return sum(int(f[11]) + int(f[12]) for f in fields) / os.sysconf("SC_CLK_TCK")

    def used(self) -> float:
        """Return the seconds of processor time of all processes, to the microsecond; on Linux only."""
        # The number of the clock of another process, as clock_getcpuclockid(3) makes it.
        return sum(time.clock_gettime((~pid << 3) | 2) for pid in self.pids)

    def memory(self) -> int:
        """Return the bytes of memory in use."""
        pages = [int(Path(f"/proc/{pid}/statm").read_text().split()[1]) for pid in self.pids]
        return sum(pages) * os.sysconf("SC_PAGE_SIZE")


@contextmanager
def lab(labs: int = 0) -> Iterator[Server]:
    """Run Armlab: one process, or a front with so many labs behind it."""
    paths = [str(HERE.parent / "app"), str(HERE.parent / "tests")]
    with started(["-c", LAB.format(paths=paths, labs=labs, tiny=TINY)]) as server:
        yield server


@contextmanager
def bare() -> Iterator[Server]:
    """Run the bare viser server."""
    with started([str(HERE / "bare_server.py")], has_front=False) as server:
        yield server


@contextmanager
def started(arguments: Sequence[str], has_front: bool = True) -> Iterator[Server]:
    """Run a Python script that prints its port and ends with its input.

    Figures need a server that has served nobody else; tables that are only to be filled share one.
    """
    if not TINY:
        with _started(arguments, has_front) as server:
            yield server
        return
    key = tuple(arguments)
    if key not in _SHARED:
        _SHARED[key] = _UNTIL_EXIT.enter_context(_started(arguments, has_front))
    yield _SHARED[key]


_SHARED: dict[tuple[str, ...], "Server"] = {}
_UNTIL_EXIT = ExitStack()
atexit.register(_UNTIL_EXIT.close)


@contextmanager
def _started(arguments: Sequence[str], has_front: bool) -> Iterator[Server]:
    process = subprocess.Popen(
        [sys.executable, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        port = int(process.stdout.readline())
        yield Server(f"http://127.0.0.1:{port}/", (process.pid, *children(process.pid)), has_front)
    finally:
        process.stdin.close()
        if not has_front:
            process.kill()  # viser alone takes no notice of its input
        try:
            process.wait(3.0)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def children(pid: int) -> tuple[int, ...]:
    """Return the processes that this one has started, and those they have."""
    path = Path(f"/proc/{pid}/task/{pid}/children")
    found = tuple(int(child) for child in path.read_text().split())
    return found + tuple(grandchild for child in found for grandchild in children(child))
