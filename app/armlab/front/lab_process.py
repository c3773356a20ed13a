"""One lab of a class: it reads settings from standard input, says that it is open, and ends when that input closes."""

from __future__ import annotations

import asyncio
import json
import logging
import sys
import threading
from contextlib import ExitStack
from pathlib import Path

from armlab.content.desk import Desk, open_desk
from armlab.content.lessons import add_folder
from armlab.content.robots import catalogue
from armlab.front.direct import DirectLine
from armlab.front.limits import Limits
from armlab.front.reception import Reception
from armlab.front.start import SWITCH_INTERVAL
from armlab.running_loop import running_loop
from armlab.ui.plugin import panels
from armlab.window.lab import Lab
from armlab.window.search.finds import prepare


def main() -> None:
    """Serve until the front has ended."""
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    sys.setswitchinterval(SWITCH_INTERVAL)
    settings = json.loads(sys.stdin.readline())
    for lessons in settings["lessons"]:
        add_folder(Path(lessons))
    if settings["teacher_key"]:
        open_desk(Desk(Path(settings["lessons"][0]), settings["teacher_key"]))
    folder = Path(settings["sessions"]) if settings["sessions"] else None
    panels()
    limits = Limits()
    with ExitStack() as opened:
        loop = opened.enter_context(running_loop("armlab-loop"))
        lab = Lab(catalogue()[settings["opening"]], folder, loop)
        opened.callback(lab.stop)
        line = DirectLine(lab.serve, limits)
        reception = Reception(settings["address"], line, limits)
        asyncio.run_coroutine_threadsafe(reception.open(), loop).result()
        print("open", flush=True)
        # Besides, since the front may end while lessons are still read: students' work is saved first, and at once.
        ended = threading.Event()
        threading.Thread(target=prepare, args=(ended,), name="armlab-index").start()
        sys.stdin.read()
        ended.set()
        asyncio.run_coroutine_threadsafe(line.say_goodbye(), loop).result()


if __name__ == "__main__":
    main()
