"""The head of a lesson: its title, and its place on the way through the course.

It can be read without the rest of the lesson, which takes longer: the first visit and the printed course need no more.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Protocol

from armlab.content.lesson_fields import Fields
from armlab.content.lesson_lines import LessonError, line_of, located
from armlab.content.lesson_values import filled_data
from armlab.content.reader import shown
from armlab.content.variants import NoValue, Value, Variants
from armlab.errors import suggestion

MOST_MINUTES = 180
"""Longest lesson, minutes."""

MOST_CAN, LONGEST_CAN = 4, 140
"""Largest number of sentences on what one can do afterwards, and the characters of the longest."""

FENCE = "+++"
"""Line before and after the front matter."""


class Headed(Protocol):
    """Anything with the head of a lesson: the head itself, or the whole lesson."""

    @property
    def key(self) -> str:
        """Name of the file or folder without ending."""
        ...

    @property
    def title(self) -> str:
        """The title."""
        ...

    @property
    def chapter(self) -> str:
        """Chapter under which it is listed where no course names it."""
        ...

    @property
    def after(self) -> tuple[str, ...]:
        """Keys of the lessons that it needs."""
        ...

    @property
    def can(self) -> tuple[str, ...]:
        """Sentences on what one can do afterwards, such as "Find the hand of an arm from its joint angles."."""
        ...

    @property
    def minutes(self) -> int:
        """Time that it takes; 0 where the file does not say."""
        ...

    @property
    def listed(self) -> bool:
        """Whether it is in lists and can be opened by itself; otherwise only assignments open it."""
        ...


@dataclass(frozen=True)
class Head:
    """The head of a lesson; the attributes are those of `Headed`."""

    key: str
    title: str
    chapter: str
    after: tuple[str, ...] = ()
    can: tuple[str, ...] = ()
    minutes: int = 0
    listed: bool = True


def head_of(key: str, text: str, file: str) -> Head:
    """Return the head of a lesson file, in its variant 0; the rest of the file may be wrong.

    Raises
    ------
    ContentError
        The front matter is not there, or wrong in one of these keys.
    """
    toml, _, _ = split(file, text)
    with located(file, "", toml, 1):
        top, _, _ = filled_front(key, file, toml, 0)
        return read_head(key, top)


def read_head(key: str, top: Fields) -> Head:
    """Take the head from the table at the top of a lesson.

    Raises
    ------
    ContentError
    """
    return Head(
        key=key,
        title=top.text("title"),
        chapter=top.text("chapter"),
        after=_after(key, top),
        can=_can(top),
        minutes=top.whole("minutes", 1, MOST_MINUTES) if top.has("minutes") else 0,
        listed=top.boolean("listed", True),
    )


def _after(key: str, top: Fields) -> tuple[str, ...]:
    """Take the lessons that are needed; whether they exist only the library knows."""
    needed = top.words("after")
    for i, each in enumerate(needed):
        if each == key:
            raise top.fail(f"after[{i + 1}]", "the lesson needs itself; name the lessons that come before it")
        if each in needed[:i]:
            raise top.fail(f"after[{i + 1}]", f"the lesson {each!r} is named twice")
    return needed


def _can(top: Fields) -> tuple[str, ...]:
    if not top.has("can"):
        return ()
    said = top.words("can", required=True)
    if not 1 <= len(said) <= MOST_CAN:
        raise top.fail("can", f"expected 1 to {MOST_CAN} sentences, got {len(said)}")
    for i, sentence in enumerate(said):
        if len(sentence) > LONGEST_CAN:
            problem = f"expected a sentence of at most {LONGEST_CAN} characters, got {len(sentence)}"
            raise top.fail(f"can[{i + 1}]", problem)
        if "{{" in sentence:
            raise top.fail(f"can[{i + 1}]", f"expected a sentence without live values, got {shown(sentence)}")
    return said


def split(file: str, text: str) -> tuple[str, str, int]:
    """Return the front matter, the Markdown, and the number of lines before the Markdown.

    The front matter begins with an empty line, so that its lines have the numbers of the file.

    Raises
    ------
    LessonError
        One of both lines around the front matter is missing.
    """
    lines = text.removeprefix("\ufeff").splitlines()
    if not lines or lines[0].strip() != FENCE:
        raise LessonError(file, "", f"expected a first line {FENCE} before title, robot and the rest", 1)
    for i, line in enumerate(lines[1:], start=1):
        if line.strip() == FENCE:
            return "\n".join(["", *lines[1:i]]), "\n".join(lines[i + 1 :]), i + 1
    raise LessonError(file, "", f"expected a second line {FENCE} after the front matter", len(lines))


def front_line(text: str, key: str) -> int:
    """Return the line, from 1, of a key of the front matter; 1 where it is not there."""
    toml, _, _ = split("", text)
    return line_of(toml, key) or 1


def variants_of(key: str, text: str) -> Variants:
    """Return what varies in a lesson file that can be used."""
    toml, _, _ = split(key, text)
    return Variants.read(key, Fields.parse(key, toml).table("variants"))


def filled_front(key: str, file: str, toml: str, variant: int) -> tuple[Fields, Mapping[str, Value], bool]:
    """Return the table at the top with the values of the variant, these values, and whether the lesson varies.

    Raises
    ------
    ContentError
    """
    top = Fields.parse(file, toml)
    # Told first: without its values the names in all other keys are unknown.
    for name in top.keys if not top.has("variants") else ():
        if isinstance(top.data[name], dict) and get_close_matches(name, ["variants"], cutoff=0.75):
            raise top.fail(name, f"unknown key{suggestion(name, ['variants'])}")
    variants = Variants.read(key, top.table("variants"))
    try:
        values = variants.draw(variant if variants.varies else 0)
    except NoValue as error:
        raise top.fail(f"variants.{error.name}", f"it has no value in variant {variant}: {error.problem}") from None
    data = {name: entry for name, entry in top.data.items() if name != "variants"}
    filled = Fields(file, filled_data(data, values, file, ""))
    filled.has("variants")  # taken above; whoever misspells a key is told that there is this one
    return filled, values, variants.varies


def time_said(minutes: int) -> str:
    """Return a time as it is told; empty for none.

    >>> time_said(12), time_said(60), time_said(85), time_said(0)
    ('12 min', '1 h', '1 h 25 min', '')
    """
    hours, rest = divmod(minutes, 60)
    return " ".join([f"{hours} h"] * bool(hours) + [f"{rest} min"] * bool(rest))
