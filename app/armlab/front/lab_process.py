"""One lab of a class: it reads settings from standard input, writes its port, and ends when standard input closes."""

from __future__ import annotations

import json
import logging
import sys
from pathlib import Path

from armlab.content.desk import Desk, open_desk
from armlab.content.lessons import add_folder
from armlab.content.robots import catalogue
from armlab.front.start import SWITCH_INTERVAL
from armlab.ui.lab import Lab
from armlab.ui.plugin import panels
from armlab.ui.search.finds import prepare


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
    lab = Lab(catalogue()[settings["opening"]], folder, settings["secret"])
    print(json.dumps({"port": lab.port}), flush=True)
    prepare()
    sys.stdin.read()
    lab.stop()


if __name__ == "__main__":
    main()
