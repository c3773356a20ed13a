"""Start of all servers: one process for a laptop, or a front with several labs for a class."""

from __future__ import annotations

import asyncio
import errno
import socket
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from aiohttp import web

from armlab import resources
from armlab.errors import ArmlabError, InputError
from armlab.front.addresses import hosts_of
from armlab.front.doors import Site, let_open_many_files
from armlab.front.front import Front
from armlab.front.handover import HandOver
from armlab.front.limits import Limits
from armlab.front.line import Line
from armlab.front.lock import FolderLock
from armlab.front.page import make_page
from armlab.front.paper_pages import PaperPages
from armlab.front.processes import LabProcesses
from armlab.front.room import Room
from armlab.front.tokens import Tokens, kept_secret
from armlab.running_loop import running_loop

if TYPE_CHECKING:
    from armlab.window.lab import Lab

SWITCH_INTERVAL = 0.0005
"""Interval, seconds, at which Python's threads take turns. With the default of 5 ms the worker would delay the event
loop that sends the poses; it is safe, as all writes to viser happen on that loop."""


SESSIONS = "sessions"
"""Folder of the students' work within that of the lab."""


class StartError(ArmlabError):
    """The lab cannot be started; the text gives the reason in one line."""


@dataclass(frozen=True)
class Settings:
    """Settings for the start.

    Attributes
    ----------
    host : str
    ports : list of int
        Tried in turn; 0 takes any free one.
    opening : str
        Key of the arm new students begin with.
    folder : Path or None
        Folder of the sessions; None keeps them in memory.
    labs : int
        Number of lab processes; 0 runs everything in this one.
    lessons : tuple of Path
        Folders of lessons besides those of the lab.
    code : str
        The code that browsers need; empty lets everybody in.
    names : tuple of str
        Names besides the host by which people get here, such as that of a proxy.
    teacher_key : str
        The key with which files are put into the first folder of lessons; empty lets nobody.
    """

    host: str
    ports: list[int]
    opening: str
    folder: Path | None
    labs: int = 0
    lessons: tuple[Path, ...] = ()
    code: str = ""
    names: tuple[str, ...] = ()
    teacher_key: str = ""


class Running:
    """A lab that is open.

    Attributes
    ----------
    port : int
    lab : Lab or None
        The lab itself; None where the labs are processes of their own.
    stopping : threading.Event
    """

    def __init__(self, port: int, opened: ExitStack, lab: Lab | None = None) -> None:
        self.port, self.lab = port, lab
        self._opened = opened
        self._first = lab.first_page if lab is not None else threading.Event()
        self.stopping = threading.Event()

    def wait_for_page(self, seconds: float) -> None:
        """Return when the first page is on a screen, the lab is to end, or the time is over.

        The labs behind the front of a class it does not know.
        """
        self._first.wait(seconds)

    def stop(self) -> None:
        """Close the connections of all pages, save, and end."""
        self.stopping.set()
        self._first.set()
        self._opened.close()


def start(settings: Settings, on_served: Callable[[int], None] = lambda port: None) -> Running:
    """Start the front, then the lab behind it; returns when both are open.

    A browser takes longest to unpack the page. So it gets that at once, and most of what the lab imports is imported
    meanwhile; its socket waits in the front.

    Parameters
    ----------
    settings : Settings
    on_served : callable
        Called with the port when the page is served.

    Raises
    ------
    StartError
        The port is in use, or the folder cannot be written.
    FolderInUse
        Another lab keeps its students there.
    InputError
        A folder of lessons is none, or there is no such arm.
    ContentError, PluginError
        The file of the arm, or a plug-in, cannot be used. All but these are raised before the page is served.
    """
    sys.setswitchinterval(SWITCH_INTERVAL)
    let_open_many_files()
    _refuse_unknown(settings)
    if settings.labs and not hasattr(socket, "send_fds"):
        raise StartError("this system passes no sockets from one process to another; leave --labs out")
    with ExitStack() as opened:
        kept = _kept_secret(settings.folder, opened)
        loop = opened.enter_context(running_loop("armlab-loop"))
        behind = opened.enter_context(ExitStack())  # closed after the front, which says goodbye to the pages
        room = Room(settings.code, kept) if settings.code else None
        hosts = hosts_of(settings.host, settings.names)
        papers = PaperPages(settings.lessons)
        front = Front(make_page(), Tokens(kept), hosts, room=room, papers=papers)
        port = _open_front(front, settings, loop, opened)
        on_served(port)
        lab, lines = _open_processes(settings, behind) if settings.labs else _open_lab(settings, loop, behind)
        loop.call_soon_threadsafe(front.open_labs, lines)
        if settings.lessons:
            _add_lessons(settings.lessons)
        # All is well: what was opened stays open until `Running.stop`.
        return Running(port, opened.pop_all(), lab)


def _refuse_unknown(settings: Settings) -> None:
    """Raise `InputError` for an arm or a folder of lessons that is not there, without reading those that are."""
    for folder in settings.lessons:
        if not folder.is_dir():
            raise InputError(f"lessons: expected a folder, got {str(folder)!r}")
    if not (resources.folder("robots") / f"{settings.opening}.toml").is_file():
        from armlab.content.robots import catalogue

        catalogue()[settings.opening]  # says which there are


def _kept_secret(folder: Path | None, opened: ExitStack) -> bytes:
    """Lock the folder for this lab, or labs of a class, and return its secret."""
    try:
        if folder is not None:
            opened.callback(FolderLock(folder).release)
            _try_writing(folder / SESSIONS)
        return kept_secret(folder)
    except OSError as error:
        raise StartError(f"cannot keep students' work in {error.filename}: {error.strerror}; use --state DIR") from None


def _try_writing(folder: Path) -> None:
    """Raise `OSError` when no session could be saved: better now than after an hour of work."""
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    try:
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(folder)) from None


def _sessions(settings: Settings) -> Path | None:
    return settings.folder / SESSIONS if settings.folder is not None else None


def _open_processes(settings: Settings, opened: ExitStack) -> tuple[None, Sequence[Line]]:
    """Open labs in processes of their own; return what leads to them."""
    processes = LabProcesses(
        settings.labs, settings.opening, _sessions(settings), settings.lessons, settings.teacher_key
    )
    opened.callback(processes.stop)
    return None, [HandOver(address) for address in processes.addresses]


def _open_lab(settings: Settings, loop: asyncio.AbstractEventLoop, opened: ExitStack) -> tuple[Lab, Sequence[Line]]:
    """Open the lab in this process, in the loop of the front; return it and what leads to it."""
    # Imported here: a browser gets its page before, and the front of a class does not need viser in its own process.
    from armlab.content.robots import catalogue
    from armlab.front.direct import DirectLine
    from armlab.window.lab import Lab

    if settings.teacher_key:
        from armlab.content.desk import Desk, open_desk

        opened.callback(open_desk(Desk(settings.lessons[0], settings.teacher_key)))
    lab = Lab(catalogue()[settings.opening], _sessions(settings), loop, settings.lessons)
    opened.callback(lab.stop)
    return lab, [DirectLine(lab.serve, Limits())]


def _add_lessons(folders: tuple[Path, ...]) -> None:
    from armlab.content.lessons import add_folder

    for folder in folders:
        add_folder(folder)


def _open_front(front: Front, settings: Settings, loop: asyncio.AbstractEventLoop, opened: ExitStack) -> int:
    """Open the front in a loop; return its port."""
    runner, port = asyncio.run_coroutine_threadsafe(_listen(front, settings), loop).result()
    opened.callback(lambda: asyncio.run_coroutine_threadsafe(runner.cleanup(), loop).result(5.0))
    return port


async def _listen(front: Front, settings: Settings) -> tuple[web.AppRunner, int]:
    runner = web.AppRunner(front.app, access_log=None, handle_signals=False, shutdown_timeout=1.0)
    await runner.setup()
    for port in settings.ports:
        try:
            await _site(runner, front, settings.host, port).start()
        except OSError as error:
            if error.errno in (errno.EADDRINUSE, errno.EACCES) and port != settings.ports[-1]:
                continue
            await runner.cleanup()
            raise StartError(_why(error, settings, port)) from None
        return runner, int(runner.addresses[-1][1])
    raise StartError("no port to try")


def _site(runner: web.AppRunner, front: Front, host: str, port: int) -> Site:
    if host != "::":
        return Site(runner, front.doors, host=host, port=port)
    # asyncio would leave IPv4 out, and with it the addresses people in the room can type.
    everywhere = socket.create_server(("::", port), family=socket.AF_INET6, dualstack_ipv6=True)
    return Site(runner, front.doors, sock=everywhere)


def _why(error: OSError, settings: Settings, port: int) -> str:
    if error.errno == errno.EADDRINUSE:
        tried = f"port {port} is" if len(settings.ports) == 1 else f"ports {settings.ports[0]} to {port} are"
        return f"{tried} in use; choose another with --port"
    if error.errno == errno.EACCES:
        return f"port {port} may not be used by this user; choose one above 1023 with --port"
    return f"cannot listen on {settings.host}: {error.strerror}"
