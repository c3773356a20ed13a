"""Commands for a shell on the computer of the lab, to be copied, each with its purpose."""

from __future__ import annotations

from armlab.ui.html import Inside, tag
from armlab.ui.markup import fold

STEPS = {
    "Check a lesson": (
        "This plays a lesson by its own solutions and says what is wrong, with file and line.",
        "armlab lesson check FILE",
    ),
    "Show lessons to a class": (
        "Lessons in the folder appear in the map, and change for everybody when a file is saved. A file course.toml "
        "beside them puts them in order. Whoever has the key loads lessons into the folder on this page.",
        "armlab --host 0.0.0.0 --lessons FOLDER --teacher-key WORD",
    ),
    "Set homework or an exam": (
        "A file NAME.toml beside your lessons is an assignment, which may be an exam; lessons/README.md has its "
        "format. The lab started with it tells the address that opens it.",
        "armlab --host 0.0.0.0 --assignment NAME.toml",
    ),
    "Print answers and points": (
        "The right answers of every variant, the points of each step, and what the last hint costs.",
        "armlab lesson sheet NAME",
    ),
    "Judge what is handed in": (
        "Students save their work as files. This judges those of a folder again and prints a table; NAME.toml for an "
        "assignment.",
        "armlab check NAME --state FOLDER",
    ),
}


def commands_markup() -> Inside:
    """Return the commands, folded."""
    steps = [(tag("h4", title), _step(*step)) for title, step in STEPS.items()]
    return fold("Commands for a class", steps, key="commands")


def _step(says: str, command: str) -> Inside:
    return tag("p", says), tag("div.bar", tag("code", command), tag("button.chip", "Copy", data_copy=command))
