"""The inventory of the course as a table: what computes a row, the pages that show it, and the lessons that teach it.

``python -m support.rows_taught`` in the folder of the tests prints it.
"""

from __future__ import annotations

import importlib
import re
import tomllib
from dataclasses import dataclass
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any, NamedTuple

from armlab.content.citations import functions
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.content.rows import rows
from armlab.session.bench import PutInPlace, robot_of
from armlab.session.job import Deliver, jobs
from armlab.session.pages import pages
from armlab.session.words import word
from support.bare_gui import BareGui, BarePage, content
from support.student import run

FILE = Path(__file__).resolve().parents[1] / "data/rows_taught.toml"

ARM = "planar_2r"
"""Arm of a page for which no example brings another."""

_MARKUP = re.compile(r"<(style|select)\b.*?</\1>|<[^>]+>", re.S)


class Shown(NamedTuple):
    """What is seen of a row on a page: page, example (or only an arm), text, and what is done before, as in `seen`."""

    page: str
    example: str
    text: str
    steps: tuple[str, ...]


class Said(NamedTuple):
    """What a lesson says of a row: lesson, title of the step, and text."""

    lesson: str
    step: str
    text: str


@dataclass(frozen=True)
class Taught:
    """One row of the table.

    Attributes
    ----------
    row : str
    core : tuple of str
        Functions of `armlab.kin` that cite it by number, or else those that the row itself or the file names.
    pages : tuple of str
        Keys of the pages that claim it.
    shown : tuple of Shown
        What the file names for each of them.
    lessons : tuple of str
        Keys of the lessons that claim it.
    said : tuple of Said
        What the file names for each of them.
    """

    row: str
    core: tuple[str, ...]
    pages: tuple[str, ...]
    shown: tuple[Shown, ...]
    lessons: tuple[str, ...]
    said: tuple[Said, ...]

    @property
    def lacks(self) -> tuple[str, ...]:
        """Some of ``core``, ``page``, ``lesson``: what the row does not have."""
        found = {"core": self.core, "page": self.pages, "lesson": self.lessons}
        return tuple(name for name, there in found.items() if not there)


@cache
def named() -> dict[str, dict[str, Any]]:
    """Return the file: what lessons say, core, and what is seen, by row."""
    return tomllib.loads(FILE.read_text(encoding="utf-8"))


@cache
def table() -> dict[str, Taught]:
    """Return the table, a row for each of the inventory, in the order of the notes."""
    file = named()
    shown, said = file["shown"], file["taught"]
    found = {}
    for row in rows().values():
        cited = tuple(one.name for one in functions() if any(map(row.cites, one.cites.references)))
        core = cited or row.core or ((file["core"][row.id],) if row.id in file["core"] else ())
        found[row.id] = Taught(
            row.id,
            core,
            tuple(key for key, page in pages().items() if row.id in page.about),
            tuple(Shown(page, example, text, tuple(steps)) for page, example, text, *steps in shown.get(row.id, ())),
            tuple(key for key, lesson in lessons().lessons.items() if row.id in lesson.teaches),
            tuple(Said(*each) for each in said.get(row.id, ())),
        )
    return found


def exists(name: str) -> bool:
    """Return whether there is a thing of this name: a robot file, a module, or a member of one."""
    if name.startswith("robots/"):
        return name.removeprefix("robots/") in catalogue().robots
    try:
        importlib.import_module(name)
    except ImportError:
        above, _, member = name.rpartition(".")
        return bool(above) and (_member(above, member) or _member(*above.rpartition(".")[::2], member))
    return True


def _member(module: str, *names: str) -> bool:
    try:
        thing: Any = importlib.import_module(module)
    except ImportError:
        return False
    for name in names:
        if not hasattr(thing, name):
            return False
        thing = getattr(thing, name)
    return True


class SpokenGui(BareGui):
    """A page whose texts can be read, in forms and outside of them."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[Any] = []

    def html(self, *inside: Any) -> Any:
        """Keep the element."""
        self.texts.append(super().html(*inside))
        return self.texts[-1]


class SpokenPage(BarePage):
    """A page that is read as a whole."""

    makes = SpokenGui

    @property
    def text(self) -> str:
        """All that it says, without markup, with single blanks."""
        gui: Any = self._gui
        parts = [content(fields) for fields in gui.has]
        parts += [str(each.handle._impl.props.content) for each in gui.texts]
        return plain(" ".join(_filled(part) for part in parts))


def plain(markup: str) -> str:
    """Return what stands in markup, with single blanks, but for what may be chosen from a list."""
    return re.sub(r"\s+", " ", unescape(_MARKUP.sub(" ", markup)))


def _filled(markup: str) -> str:
    """Return markup with what stands in its fields as text."""
    return re.sub(r'<input[^>]*\bvalue="([^"]*)"[^>]*>', r" \1 ", markup)


@cache
def seen(page: str, example: str, *steps: str) -> str:
    """Return the text of a page with an example in place, or else with the arm that is named instead of one.

    What may be chosen from a list does not count: the names of all examples are there, whichever is in place.

    Parameters
    ----------
    page, example : str
    *steps : str
        What is done then: ``press CELL``, a button of the page, ``do WORD ARGUMENT=TEXT``, a command as lessons write
        it, or ``job KEY``, which is carried through.
    """
    return run(_seen(page, example, steps))


async def _seen(page: str, example: str, steps: tuple[str, ...]) -> str:
    robot = (robot_of(example) if "/" in example else example) or ARM
    opened = SpokenPage(page, catalogue()[robot])
    if "/" in example:
        opened.session.apply(PutInPlace(example), 1.0)
        opened.show()
    for step in steps:
        what, _, name = step.partition(" ")
        {"press": _press, "do": _do, "job": _carry_through}[what](opened, name)
    return opened.text


@cache
def steps_of(lesson: str) -> dict[str, str]:
    """Return the texts of the steps of a lesson by their titles: all that is to be read at each, without markup."""
    return {step.title: plain(step.texts) for step in lessons().lessons[lesson].steps}


def _press(opened: SpokenPage, wanted: str) -> None:
    """Press the button of a page that has this cell."""
    (fields,) = (fields for fields, cell, _ in opened.controls("button") if cell == wanted)
    opened.send(fields, wanted)


def _do(opened: SpokenPage, written: str) -> None:
    """Apply a command by its word and its arguments, texts alone."""
    name, *given = written.split()
    opened.session.apply(word(name).make(**dict(argument.split("=") for argument in given)), 2.0)
    opened.show()


def _carry_through(opened: SpokenPage, key: str) -> None:
    """Do the whole work of a job, as it is wanted while the page is open."""
    job = jobs()[key]
    wanted = job.wanted(opened.session.state, frozenset({opened._gui.page}))
    assert wanted is not None, f"{key} has nothing to do"
    for found in job.run(wanted.inputs):
        if found is not None:
            opened.session.apply(Deliver(job, wanted.inputs, found), 2.0)
    opened.show()


def main() -> None:
    """Print the table."""
    print("| row | core | pages: what is seen | lessons: steps |\n| --- | --- | --- | --- |")
    for each in table().values():
        shown = "; ".join(f"{one.page}: {one.text}" for one in each.shown).replace("|", r"\|")
        said = "; ".join(f"{one.lesson}: {one.step}" for one in each.said)
        print(f"| {each.row} | {', '.join(each.core[:2])} | {shown} | {said} |")


if __name__ == "__main__":
    main()
