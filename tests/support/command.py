"""The command line as a process of its own, wherever the tests themselves were started from."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

APP = Path(__file__).resolve().parents[2] / "app"
MAIN = "from armlab.cli import main; sys.exit(main(sys.argv[1:]))"

TERMINAL = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
"""Ctrl-C counts, as in a terminal: what a shell starts in the background ignores it, and so do its children."""

_STARTED: list[subprocess.Popen[str]] = []


def command(*arguments: object, code: str = MAIN, **options: Any) -> subprocess.Popen[str]:
    """Start a command, or other code, whose output and complaints can be read."""
    code = f"{TERMINAL}sys.path.insert(0, {str(APP)!r}); {code}"
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", code, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )
    _STARTED.append(process)
    return process


def end_all() -> None:
    """End what a test has left running: one that fails must not make a later one complain."""
    while _STARTED:
        process = _STARTED.pop()
        process.kill()
        process.wait()
        for pipe in (process.stdout, process.stderr):
            if pipe is not None:
                pipe.close()
