"""The command line: start the lab, print its address, open the browser."""

from __future__ import annotations

import argparse
import contextlib
import gc
import logging
import os
import queue
import signal
import sys
import threading
import webbrowser
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from urllib.parse import quote

from armlab import __version__
from armlab.errors import ArmlabError, InputError, PluginError
from armlab.front.addresses import addresses
from armlab.front.room import LONGEST

if TYPE_CHECKING:
    from armlab.front.start import Running

DEFAULT_ROBOT = "puma560"
DEFAULT_PORTS = range(8080, 8100)

UNVISITED = 3.0
"""Time, seconds, after which a lab that nobody has opened yet looks whether all of it can be used."""

# A signal may come at any point of the main thread; of all that waits only this queue can be told in the middle of it.
Ended: TypeAlias = "queue.SimpleQueue[str]"
"""The reasons to end, one after the other: an empty text when a person wants it."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command, or without one the lab until Ctrl-C; return the exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments and not arguments[0].startswith("-"):
        from armlab.commands import run_command

        return run_command(arguments)
    options = parser().parse_args(arguments)
    gc.disable()  # until the first page: of what the start makes nothing is garbage, and looking takes a seventh of it
    from armlab.front.start import Settings, start

    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    ended: Ended = queue.SimpleQueue()
    try:
        if options.teacher_key and not options.lessons:
            raise InputError("--teacher-key: expected a folder for what is loaded, too; add --lessons DIR")
        path = _assigned(options)
    except (ArmlabError, OSError) as error:
        print(f"armlab: {error}", file=sys.stderr)
        return 1
    settings = Settings(
        host=options.host,
        ports=[options.port] if options.port is not None else list(DEFAULT_PORTS),
        opening=options.robot,
        folder=state_folder(options.state),
        labs=options.labs,
        lessons=tuple(options.lessons),
        code=options.code or "",
        names=tuple(options.name),
        teacher_key=options.teacher_key or "",
    )
    try:
        running = start(settings, lambda port: _tell(port, options, ended, path))
    except ArmlabError as error:
        gc.enable()
        print(f"armlab: {error}", file=sys.stderr)
        return 1
    return _run(running, ended)


def _assigned(options: argparse.Namespace) -> str:
    """Return the path of the assignment that is given to the class; empty for none. Its folder is one of lessons."""
    if options.assignment is None:
        return ""
    from armlab.commands._found import Place

    found = Place(options.lessons).assignment(str(options.assignment))
    if found is None:
        raise InputError(f"--assignment: expected a file NAME.toml, got {str(options.assignment)!r}")
    if options.assignment.suffix == ".toml":  # else the key of one in the folders of lessons
        options.lessons.append(options.assignment.parent)
    return f"assignment/{found.key}"


def _tell(port: int, options: argparse.Namespace, ended: Ended, path: str) -> None:
    """Say where the lab is and open a browser there; from now on Ctrl-C ends the lab in order."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ended.put(""))
    own, others = addresses(options.host, port)
    own, others = own + path, [other + path for other in others]
    own += f"?code={quote(options.code)}" if options.code else ""
    print(f"Armlab is open at {own}")
    for other in others:
        print(f"Others in the room type {other}" + (f" and the code {options.code}" if options.code else ""))
    print("Stop it with Ctrl-C.", flush=True)
    if not options.no_browser:
        threading.Thread(target=_open_browser, args=(own,), daemon=True).start()


def _run(running: Running, ended: Ended) -> int:
    """Wait for the end, and meanwhile look for what is broken; return the exit status."""
    looking = threading.Thread(target=_look, args=(running, ended), name="armlab-looking")
    looking.start()
    problem = _wait(ended)
    running.stop()
    looking.join()
    if problem:
        print(f"armlab: {problem}", file=sys.stderr)
    return 1 if problem else 0


def _look(running: Running, ended: Ended) -> None:
    """Say which robots and lessons cannot be used, and end a lab with a page that cannot be.

    All of them are imported and read for this, which takes longer than the start. So it comes after the first page.
    """
    from armlab.content.lessons import lessons, read_unhurried
    from armlab.content.robots import catalogue

    running.wait_for_page(UNVISITED)
    gc.enable()
    if running.stopping.is_set():
        return
    if running.lab is not None:
        from armlab.ui.plugin import panels  # the front of a class does without; its labs look themselves

        try:
            panels()
        except PluginError as error:
            ended.put(str(error))
            return
        from armlab.window.search.finds import prepare

        prepare(running.stopping)
    if not read_unhurried(running.stopping):
        return
    for problem in (*catalogue().problems, *lessons().problems):
        print(f"armlab: {problem}", file=sys.stderr)


def _wait(ended: Ended) -> str:
    while True:
        # Where a waiting thread hears no signal, it does now and then.
        with contextlib.suppress(queue.Empty):
            return ended.get(timeout=1.0)


def _open_browser(address: str) -> None:
    try:
        opened = webbrowser.open(address)
    except (webbrowser.Error, OSError):
        opened = False
    if not opened:
        print(f"No browser could be opened: open {address} yourself.", flush=True)


def parser() -> argparse.ArgumentParser:
    """Return the options."""
    p = _Parser(prog="armlab", description="A robot-arm laboratory in the browser.")
    p.add_argument("--host", default="127.0.0.1", help="address to listen on; 0.0.0.0 lets others in the room in")
    p.add_argument("--port", type=_port, help="port to listen on; by default the first free one from 8080")
    p.add_argument("--no-browser", action="store_true", help="do not open a browser")
    p.add_argument("--code", type=_code, metavar="WORD", help="what a browser is asked for before it gets in")
    p.add_argument(
        "--name",
        action="append",
        default=[],
        help="a name people get here by besides the host, such as that of a proxy; may be repeated",
    )
    p.add_argument("--robot", default=DEFAULT_ROBOT, metavar="NAME", help=f"arm of new students ({DEFAULT_ROBOT})")
    p.add_argument("--labs", type=_count, default=0, metavar="N", help="for a class: N lab processes behind one front")
    p.add_argument(
        "--lessons", type=Path, action="append", default=[], metavar="DIR", help="a folder of lessons; may be repeated"
    )
    p.add_argument(
        "--teacher-key", type=_key, metavar="WORD", help="who has it loads lessons for everybody into the first DIR"
    )
    p.add_argument("--assignment", type=Path, metavar="FILE", help="an assignment; the addresses that are told open it")
    p.add_argument("--state", type=Path, metavar="DIR", help="where students' work is kept")
    p.add_argument("--version", action="version", version=f"armlab {__version__}")
    return p


class _Parser(argparse.ArgumentParser):
    """Its help also lists the commands, which are looked for only then."""

    def format_help(self) -> str:
        from armlab.commands import command_types, listing

        return f"{super().format_help()}\n{listing(command_types())}"


def _port(text: str) -> int:
    if not text.isdecimal() or not 0 <= int(text) <= 65535:
        raise argparse.ArgumentTypeError(f"expected a number from 0 to 65535, got {text!r}")
    return int(text)


def _count(text: str) -> int:
    if not text.isdecimal() or not 0 <= int(text) <= 64:
        raise argparse.ArgumentTypeError(f"expected a number from 0 to 64, got {text!r}")
    return int(text)


def _code(text: str) -> str:
    if not 4 <= len(text.strip()) <= LONGEST:
        raise argparse.ArgumentTypeError(f"expected 4 to {LONGEST} characters, got {len(text.strip())}")
    return text


def _key(text: str) -> str:
    if not 8 <= len(text.strip()) <= LONGEST:
        raise argparse.ArgumentTypeError(f"expected 8 to {LONGEST} characters, got {len(text.strip())}")
    return text.strip()


def state_folder(chosen: Path | None) -> Path:
    """Return where sessions are kept: the given folder, or the user's place for such data."""
    if chosen is not None:
        return chosen
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_STATE_HOME", Path.home() / ".local" / "state"))
    return base / "armlab"
