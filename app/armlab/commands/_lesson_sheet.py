"""``armlab lesson sheet``: the values and the right answers of a lesson, for the teacher."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from armlab.commands import CommandType
from armlab.errors import ContentError, InputError

if TYPE_CHECKING:
    from armlab.content.lesson import Lesson

VARIANTS = "0-30"
MOST_VARIANTS = 1000
LAST_VARIANT = 9999
LARGEST_LIST = 1_000_000
"""Largest size of a list of names, bytes."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    from armlab.commands._found import add_lessons_option

    parser.add_argument("lesson", metavar="LESSON", help="its name, or its file or folder; or that of an assignment")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--variants", metavar="N-M", default=VARIANTS, help=f"such as 0-30 or 1,4,7-9 ({VARIANTS})")
    which.add_argument("--students", type=Path, metavar="FILE", help="names, one a line: the first has variant 1")
    add_lessons_option(parser)


def run(options: argparse.Namespace) -> int:
    """Print the sheet as Markdown; return 0 when every variant can be used."""
    from armlab.commands._found import Place
    from armlab.commands._scheme import scheme
    from armlab.commands._sheet import sheet
    from armlab.content.lessons import lessons

    place = Place(options.lessons)
    students = names_of(options.students) if options.students else {}
    numbers = list(students) if options.students else numbers_of(options.variants)
    assigned = place.assignment(options.lesson)
    if assigned is None:
        first = place.one(options.lesson).lesson()
        variants = _variants(first, numbers)
        print(sheet(first, variants, students), end="")
        return 1 if first.varies and len(variants) < len(numbers) else 0
    print(scheme(assigned), end="")
    complete = True
    for task in assigned.tasks:
        first, own = lessons()[task.lesson], task.variant is None
        wanted = numbers if own else [task.number(0)]
        variants = _variants(first, wanted)
        complete = complete and (not first.varies or len(variants) == len(wanted))
        print(f"\n{sheet(first, variants, students if own else {}, 2)}", end="")
    return 0 if complete else 1


def _variants(first: Lesson, numbers: Sequence[int]) -> list[tuple[int, Lesson]]:
    """Return the variants of a lesson that can be used, 0 alone where it does not vary; say why others cannot."""
    from armlab.content.lessons import lesson

    found = []
    for number in numbers if first.varies else [0]:
        try:
            found.append((number, lesson(first.key, number)))
        except ContentError as error:
            print(f"armlab: variant {number}: {error}", file=sys.stderr)
    return found


def numbers_of(text: str) -> list[int]:
    """Return the numbers of variants in a text such as ``1,4,7-9``.

    Raises
    ------
    InputError

    Examples
    --------
    >>> numbers_of("1,4,7-9")
    [1, 4, 7, 8, 9]
    """
    found: dict[int, None] = {}
    for part in text.split(","):
        ends = re.fullmatch(r"\s*(\d{1,4})(?:\s*-\s*(\d{1,4}))?\s*", part, re.ASCII)
        low, high = (int(ends[1]), int(ends[2] or ends[1])) if ends else (1, 0)
        if high < low:
            raise InputError(f"--variants: expected numbers up to {LAST_VARIANT} such as 0-30 or 1,4,7-9, got {text!r}")
        found |= dict.fromkeys(range(low, high + 1))
    if len(found) > MOST_VARIANTS:
        raise InputError(f"--variants: expected at most {MOST_VARIANTS} of them, got {len(found)}")
    return list(found)


def names_of(path: Path) -> dict[int, str]:
    """Return the names of a list by the number of their variant, from 1; empty lines are left out.

    Raises
    ------
    InputError
    """
    with path.open("rb") as stream:
        data = stream.read(LARGEST_LIST + 1)
    if len(data) > LARGEST_LIST:
        raise InputError(f"{path}: expected a list of names, one a line, got more than {LARGEST_LIST // 1000} kB")
    try:
        lines = data.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise InputError(f"{path}: expected text in UTF-8; save the list again in this encoding") from None
    names = [" ".join(line.split()) for line in lines if line.strip()]
    if not 1 <= len(names) <= MOST_VARIANTS:
        raise InputError(f"{path}: expected 1 to {MOST_VARIANTS} names, one a line, got {len(names)}")
    return dict(enumerate(names, start=1))


PART = CommandType(
    "sheet", 30, "Write down the right answers of a lesson or an assignment, by variant.", add_arguments, run
)
