"""``armlab lesson new``: a lesson to begin with."""

from __future__ import annotations

import argparse
from pathlib import Path

from armlab.commands import CommandType
from armlab.errors import InputError

DEFAULT_ROBOT = "planar_2r"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("name", metavar="NAME", help="of the file, in lower-case letters, digits and underscores")
    parser.add_argument("--robot", default=DEFAULT_ROBOT, metavar="KEY", help=f"its arm ({DEFAULT_ROBOT})")
    parser.add_argument("--to", type=Path, default=Path(), metavar="DIR", help="the folder to write it to (this one)")


def run(options: argparse.Namespace) -> int:
    """Write the file; a file that is there already stays as it is."""
    from armlab.commands._found import README
    from armlab.content.lessons import lessons
    from armlab.content.new_lesson import new_lesson
    from armlab.content.robots import KEY, catalogue

    name = options.name.removesuffix(".md")
    if not KEY.match(name):
        raise InputError(f"name: expected lower-case letters, digits and underscores, at most 64, got {name[:80]!r}")
    if f"{name}.md" == README:
        raise InputError(f"name: a file {README} is read by people and is no lesson; choose another name")
    if name in lessons().lessons:
        raise InputError(f"name: there is a lesson {name!r} in the lab; choose another name")
    text = new_lesson(catalogue()[options.robot])
    if not options.to.is_dir():
        raise InputError(f"{options.to}: there is no such folder")
    path = options.to / f"{name}.md"
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError:
        raise InputError(f"{path} is there already; it stays as it is") from None
    print(f"{path} is written. Edit it, and look at it with")
    print(f"  armlab lesson check {path}")
    print(f"  armlab --lessons {options.to}")
    return 0


PART = CommandType("new", 10, "Write a small lesson that works, to be made into your own.", add_arguments, run)
