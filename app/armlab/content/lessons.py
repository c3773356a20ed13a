"""Lesson files: ``lessons/*.md``, one lesson a file; TOML between two lines ``+++``, then Markdown with LaTeX.

Steps are the sections that begin with ``## Title``. A step may carry one fenced block ``check`` and one ``question``,
both in TOML. What is written before the first step introduces the lesson.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.resources.abc import Traversable
from typing import cast

import numpy as np
from markdown_it.token import Token
from numpy.typing import NDArray

from armlab import resources
from armlab.content import robots
from armlab.content.check import Check, read_check
from armlab.content.folder import Folder
from armlab.content.markdown import render, to_html, tokens_of
from armlab.content.questions import Question, read_question
from armlab.content.reader import Table, joint_values, shown
from armlab.content.robots import KEY, Robot, read_pose
from armlab.errors import ContentError, UnknownName, suggestion

BLOCKS = ("check", "question")
CODE = ("", "python", "text", "toml")
"""Languages of fenced blocks that are shown as they are."""

ROW = re.compile(r"S\d+(\.\d+)*-[A-Za-z0-9-]+\Z")
"""Names of the rows of the inventory, such as ``S4.1-dh``."""

_README = "README.md"
_FENCE = "+++"


@dataclass(frozen=True, eq=False)
class Step:
    """One step: what to read, and what to do or to answer, if anything."""

    title: str
    html: str
    check: Check | None
    question: Question | None


@dataclass(frozen=True, eq=False)
class Lesson:
    """A lesson file.

    Attributes
    ----------
    key : str
        File name without its ending.
    title, chapter : str
    teaches : tuple of str
        Rows of the inventory.
    robot : str
        Key of its arm.
    start : ndarray, shape (n,)
        Where the arm stands at first; radians and metres.
    panel : str
        The panel that is opened; empty for none.
    overlays : tuple of str
        What is drawn besides the arm.
    target : ndarray, shape (4, 4), or None
        Where the handle stands at first, in the world.
    intro_html : str
    steps : tuple of Step
    """

    key: str
    title: str
    chapter: str
    teaches: tuple[str, ...]
    robot: str
    start: NDArray[np.float64]
    panel: str
    overlays: tuple[str, ...]
    target: NDArray[np.float64] | None
    intro_html: str
    steps: tuple[Step, ...]


class _FrontMatter(Table):
    """The table at the top of a lesson, which has lists of words."""

    def words(self, key: str, *, required: bool = False) -> tuple[str, ...]:
        """Take a list of texts."""
        value = self._take(key, None if required else [])
        if not isinstance(value, list) or not all(isinstance(word, str) and word for word in value):
            raise self.fail(key, f"expected a list of texts, got {shown(value)}")
        return tuple(value)


def parse_lesson(key: str, text: str, file: str | None = None, catalogue: robots.Catalogue | None = None) -> Lesson:
    """Read the text of a lesson file.

    Parameters
    ----------
    key, text : str
    file : str, optional
        Its name in messages.
    catalogue : Catalogue, optional
        The robots there are; those of the lab when left out.

    Raises
    ------
    ContentError
        Anything wrong, with file, step and key, what was expected and what is available.
    """
    file = file or f"{key}.md"
    if not KEY.match(key):
        raise ContentError(
            file, "", f"expected a file name of lower-case letters, digits and underscores, got {key!r}; rename it"
        )
    front, body, first_line = _split(file, text)
    top = cast(_FrontMatter, _FrontMatter.parse(file, "\n" + front))
    robot = _robot(top, catalogue or robots.catalogue())
    target = top.table("target")
    intro, *sections = _sections(tokens_of(body))
    lesson = Lesson(
        key=key,
        title=top.text("title"),
        chapter=top.text("chapter"),
        teaches=_teaches(top),
        robot=robot.key,
        start=_start(top, robot),
        panel=top.text("panel", ""),
        overlays=top.words("overlays"),
        target=None if target is None else read_pose(target),
        intro_html=render(intro, file, "introduction"),
        steps=tuple(_step(file, i + 1, section, robot, first_line) for i, section in enumerate(sections)),
    )
    top.done()
    if not sections:
        raise ContentError(file, "", "expected at least one step, a section that begins with '## Title'")
    return lesson


def _split(file: str, text: str) -> tuple[str, str, int]:
    """Return the front matter, the Markdown, and the number of lines before the Markdown."""
    lines = text.removeprefix("\ufeff").splitlines()
    if not lines or lines[0].strip() != _FENCE:
        raise ContentError(file, "", f"expected a first line {_FENCE} before title, robot and the rest")
    for i, line in enumerate(lines[1:], start=1):
        if line.strip() == _FENCE:
            return "\n".join(lines[1:i]), "\n".join(lines[i + 1 :]), i + 1
    raise ContentError(file, "", f"expected a second line {_FENCE} after the front matter")


def _robot(top: Table, catalogue: robots.Catalogue) -> Robot:
    name = top.text("robot")
    try:
        return catalogue[name]
    except UnknownName:
        raise top.fail("robot", f"unknown robot {name!r}{suggestion(name, catalogue.robots)}") from None
    except ContentError as error:
        raise top.fail("robot", f"its file cannot be used: {error}") from None


def _teaches(top: _FrontMatter) -> tuple[str, ...]:
    rows = top.words("teaches", required=True)
    for row in rows:
        if not ROW.match(row):
            raise top.fail("teaches", f"expected rows of the inventory such as 'S4.1-dh', got {row!r}")
    return rows


def _start(top: Table, robot: Robot) -> NDArray[np.float64]:
    """Take the name of a pose or joint values; without either the arm's first pose."""
    given = [key for key in ("pose", "q_deg", "q_m", "q_deg_m") if top.has(key)]
    if len(given) > 1:
        raise top.fail(given[1], f"expected one of {' and '.join(given)}")
    if not given:
        return robot.home
    if given == ["pose"]:
        return robot.poses[top.choice("pose", robot.poses)]
    q = joint_values(top, "".join(row.kind for row in robot.arm.rows))
    if not robot.arm.within_limits(q):
        raise top.fail(given[0], f"outside the joint limits of {robot.name}")
    q.setflags(write=False)
    return q


def _sections(tokens: list[Token]) -> list[list[Token]]:
    """Return the blocks before the first heading of level 2, then those from each such heading on."""
    sections: list[list[Token]] = [[]]
    for token in tokens:
        if token.type == "heading_open" and token.tag == "h2" and token.level == 0:
            sections.append([])
        sections[-1].append(token)
    return sections


def _step(file: str, number: int, section: list[Token], robot: Robot, first_line: int) -> Step:
    where = f"step {number}"
    _, title, _, *blocks = section
    found: dict[str, Token] = {}
    text = []
    for token in blocks:
        name = token.info.strip() if token.type == "fence" else ""
        if name not in BLOCKS:
            if name not in CODE:
                raise ContentError(file, where, f"unknown block {name!r}{suggestion(name, (*BLOCKS, *CODE[1:]))}")
            text.append(token)
        elif name in found:
            raise ContentError(file, f"{where}.{name}", "expected one in a step; begin another step with '## Title'")
        else:
            found[name] = token
    tables = {name: _block(file, f"{where}.{name}", token, first_line) for name, token in found.items()}
    return Step(
        title=title.content,
        html=render(text, file, where),
        check=read_check(tables["check"], robot) if "check" in tables else None,
        question=read_question(tables["question"], lambda text, key: to_html(text, file, key))
        if "question" in tables
        else None,
    )


def _block(file: str, where: str, token: Token, first_line: int) -> Table:
    """Return the table of a fenced block; lines in messages are those of the file."""
    before = first_line + (token.map[0] if token.map else 0) + 1
    try:
        table = Table.parse(file, "\n" * before + token.content)
    except ContentError as error:
        raise ContentError(file, where, error.problem) from None
    table.where = where
    return table


class Lessons(Folder[Lesson]):
    """All lesson files."""

    kind = "lesson"
    ending = ".md"

    @property
    def lessons(self) -> dict[str, Lesson]:
        """The lessons by key, in the order of their chapters."""
        return self.found


def read_lessons(files: Iterable[Traversable]) -> Lessons:
    """Read lesson files; a broken one is reported and disturbs nothing else."""
    wanted = (file for file in files if file.name != _README)
    return Lessons.read(wanted, parse_lesson, lambda lesson: (_numbers(lesson.chapter), lesson.chapter, lesson.key))


def _numbers(chapter: str) -> list[int]:
    """Return the number a chapter begins with, so that 10 comes after 9."""
    number = re.match(r"[\d.]*", chapter)
    return [int(part) for part in re.findall(r"\d{1,9}", number[0] if number else "")]


@cache
def lessons() -> Lessons:
    """Return the lessons that come with the lab, read once."""
    return read_lessons(resources.files("lessons", ".md"))
