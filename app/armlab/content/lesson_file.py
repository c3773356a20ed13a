"""Lesson files: TOML between two lines ``+++``, then Markdown with LaTeX.

Steps are the sections that begin with ``## Title``. A step may carry fenced blocks: ``start``, ``check``, ``question``
and ``solution`` in TOML, ``hint`` and ``reveal`` in Markdown. The text before the first step introduces the lesson.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from armlab.content import robots
from armlab.content.as_written import as_written
from armlab.content.bench_words import placed
from armlab.content.lesson import Lesson
from armlab.content.lesson_front import read_front
from armlab.content.lesson_head import filled_front, split
from armlab.content.lesson_lines import LessonError, located
from armlab.content.lesson_steps import TABLES, TEXTS, Setting, read_step, refuse_swallowed, sections_of
from armlab.content.lesson_text import Prose
from armlab.content.lesson_values import filled
from armlab.content.markdown import tokens_of
from armlab.content.robots import KEY, Catalogue
from armlab.content.variants import Value
from armlab.errors import ContentError, InputError
from armlab.kin.checks import whole_number

if TYPE_CHECKING:
    from markdown_it.token import Token

MOST_STEPS = 200
"""Largest number of steps of a lesson; a lesson of one hour has about ten."""

_OPENED = "{{="


def parse_lesson(
    key: str,
    text: str,
    file: str | None = None,
    catalogue: Catalogue | None = None,
    variant: int = 0,
    pictures: Mapping[str, str] | None = None,
    own: bool = False,
) -> Lesson:
    """Read the text of a lesson file.

    Parameters
    ----------
    key, text : str
    file : str, optional
        Its name in messages.
    catalogue : Catalogue, optional
        The robots there are; those of the lab when left out.
    variant : int, optional
        Number of the variant, from 0. A lesson that does not vary is always its variant 0.
    pictures : mapping of str to str, optional
        Names of the pictures beside it to ``data:`` addresses; a single file has None and can show none.
    own : bool, optional
        Whether it is none of the lab's: its texts are not translated.

    Raises
    ------
    ContentError
        Anything wrong, with file, line, step and key, what was expected and what is available.
    InputError
        The variant is not a whole number from 0.
    """
    file, variant = file or f"{key}.md", whole_number(variant, "variant", 0)
    if not KEY.match(key):
        raise ContentError(
            file, "", f"expected a file name of lower-case letters, digits and underscores, got {key!r}; rename it"
        )
    toml, body, before = split(file, text)
    with located(file, "", toml, 1):
        top, values, varies = filled_front(key, file, toml, variant)
        front = read_front(key, top, catalogue or robots.catalogue())
    prose = Prose.of(file, front.robot.arm, pictures, own)
    setting = Setting(file, before, front.robot, catalogue or robots.catalogue(), values, varies and variant > 0, prose)
    intro, *sections = sections_of(tokens_of(_filled_body(file, body, before, values)))
    if not sections:
        line = before + body.count("\n") + 1
        raise LessonError(file, "", "expected at least one step, a section that begins with '## Title'", line)
    if len(sections) > MOST_STEPS:
        line = setting.line(sections[MOST_STEPS][0])
        raise LessonError(file, "", f"expected at most {MOST_STEPS} steps, got {len(sections)}", line)
    _only_text(setting, intro)
    intro_html = prose.html(intro, "introduction", before)
    lesson = Lesson(
        key=key,
        file=file,
        title=front.head.title,
        chapter=front.head.chapter,
        after=front.head.after,
        can=front.head.can,
        minutes=front.head.minutes,
        listed=front.head.listed,
        teaches=front.teaches,
        robot=front.robot.key,
        robot_used=front.robot,
        start=front.start,
        panel=front.panel,
        example=front.example,
        begin=placed(front.begin, toml),
        overlays=front.overlays,
        target=front.target,
        camera=front.camera,
        locked=front.locked,
        locked_joints=front.locked_joints,
        hidden=front.hidden,
        variant=variant if varies else 0,
        values=MappingProxyType(values),
        varies=varies,
        digest=digest_of(text, pictures),
        intro_html=intro_html,
        live=prose.used,
        steps=tuple(read_step(setting, i + 1, section) for i, section in enumerate(sections)),
    )
    if not own:
        return lesson
    steps = tuple(as_written(step, "title") for step in lesson.steps)
    return as_written(replace(lesson, steps=steps), "title", "chapter", "can")


def _only_text(setting: Setting, intro: list[Token]) -> None:
    """Refuse a block that belongs to a step: in an introduction it would have no effect."""
    for token in intro:
        name = token.info.strip() if token.type == "fence" else ""
        if name in (*TABLES, *TEXTS):
            problem = f"expected a block {name!r} in a step, after its '## Title'; it stands before the first one"
            raise LessonError(setting.file, "introduction", problem, setting.line(token))
        refuse_swallowed(setting, "introduction", token)


def digest_of(text: str, pictures: Mapping[str, str] | None = None) -> str:
    """Return 16 hexadecimal digits that change whenever the text or a picture changes."""
    found = hashlib.sha256(text.encode("utf-8", "surrogatepass"))
    for name, address in sorted((pictures or {}).items()):
        found.update(f"\0{name}\0{address}".encode())
    return found.hexdigest()[:16]


def _filled_body(file: str, body: str, before: int, values: Mapping[str, Value]) -> str:
    """Return the Markdown with the values of the variant; TOML blocks are left to be filled in later."""
    if _OPENED not in body:
        return body
    lines, signs = body.split("\n"), _minus_signs(body)
    for i, line in enumerate(lines):
        if _OPENED not in line or not signs[i]:
            continue
        try:
            lines[i] = filled(line, values, signs[i])
        except InputError as error:
            raise LessonError(file, "", str(error), before + i + 1) from None
    return "\n".join(lines)


def _minus_signs(body: str) -> list[str]:
    """Return the minus sign of each line: a hyphen in code, none in TOML blocks."""
    signs = ["\u2212"] * (body.count("\n") + 1)
    for token in tokens_of(body):
        if token.type == "fence" and token.map:
            name = token.info.strip()
            sign = "" if name in TABLES else "\u2212" if name in TEXTS else "-"
            first, end = token.map
            signs[first:end] = [sign] * (end - first)
    return signs
