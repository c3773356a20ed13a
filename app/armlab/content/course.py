"""Courses: an order of lessons in chapters, and the mistakes in a file of one."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

from armlab.content.lesson_fields import Fields
from armlab.content.lesson_head import Headed
from armlab.content.lesson_lines import LessonError, line_of, located
from armlab.content.reader import Table
from armlab.errors import suggestion

_WORD = re.compile(r"""\#[^\n]* | "([^"\n]*)" | '([^'\n]*)'""", re.VERBOSE)
"""A comment, or a text in quotes."""


@dataclass(frozen=True)
class Chapter:
    """A chapter of a course.

    Attributes
    ----------
    title, about : str
        ``about`` is a sentence or two; empty for none.
    lessons : tuple of str
        Keys, in order.
    """

    title: str
    about: str
    lessons: tuple[str, ...]


@dataclass(frozen=True)
class Course:
    """A course.

    Attributes
    ----------
    key : str
        Name by which it is chosen; that of the lab is `armlab.content.courses.OF_THE_LAB`.
    title, about : str
    chapters : tuple of Chapter
    """

    key: str
    title: str
    about: str
    chapters: tuple[Chapter, ...]

    @cached_property
    def lessons(self) -> tuple[str, ...]:
        """Keys of all its lessons, in order."""
        return tuple(key for chapter in self.chapters for key in chapter.lessons)

    @cached_property
    def chapter_of(self) -> Mapping[str, str]:
        """Title of the chapter of each lesson."""
        return {key: chapter.title for chapter in self.chapters for key in chapter.lessons}

    def among(self, these: Collection[str]) -> Course:
        """Return the course without lessons other than these, and without chapters of which nothing is left."""
        if all(key in these for key in self.lessons):
            return self
        kept = [replace(each, lessons=tuple(key for key in each.lessons if key in these)) for each in self.chapters]
        return replace(self, chapters=tuple(chapter for chapter in kept if chapter.lessons))


def parse_course(key: str, text: str, file: str) -> Course:
    """Read the text of a course file.

    Parameters
    ----------
    key, text : str
    file : str
        Its name in messages.

    Raises
    ------
    LessonError
        It is no TOML, a key is missing or unknown, or a lesson or the title of a chapter is there twice.
    """
    with located(file, "", text, 1):
        top = Table.parse(file, text)
        tables = top.tables("chapters")
        course = Course(key, top.text("title"), top.text("about", ""), tuple(map(_chapter, tables)))
        top.done()
        if not tables:
            raise top.fail("chapters", "expected at least one chapter, a table [[chapters]] with title and lessons")
        titles = [chapter.title for chapter in course.chapters]
        for i, title in enumerate(titles):
            if title in titles[:i]:
                raise tables[i].fail("title", f"chapter {titles.index(title) + 1} has this title, too; change one")
    _refuse_twice(course, text, file)
    return course


def _chapter(table: Table) -> Chapter:
    fields = Fields.of(table)
    chapter = Chapter(fields.text("title"), fields.text("about", ""), fields.words("lessons", required=True))
    fields.done()
    if not chapter.lessons:
        raise fields.fail("lessons", "expected at least one lesson, got an empty list")
    return chapter


def _refuse_twice(course: Course, text: str, file: str) -> None:
    first: dict[str, str] = {}
    for key, where in _places(course):
        if key in first:
            line = _line_of_word(text, key, 1) or line_of(text, where.partition("[")[0])
            raise LessonError(file, where, f"the lesson {key!r} is in the course already, at {first[key]}", line or 1)
        first[key] = where


def _places(course: Course) -> Iterator[tuple[str, str]]:
    """Yield all lessons with their places in the file."""
    for i, chapter in enumerate(course.chapters, start=1):
        for j, key in enumerate(chapter.lessons, start=1):
            yield key, f"chapters[{i}].lessons[{j}]"


def misplaced(
    course: Course, text: str, file: str, known: Collection[str], needs: Mapping[str, Iterable[str]]
) -> Iterator[LessonError]:
    """Yield the lessons of a course that do not exist, or stand before what they need.

    Parameters
    ----------
    course : Course
    text, file : str
        Those of its file.
    known : collection of str
        Keys of all lessons.
    needs : mapping of str to iterable of str
        Keys of the lessons that each one needs; those that the course does not hold need not come first.
    """
    order = {key: i for i, key in enumerate(course.lessons)}
    for key, where in _places(course):
        line = _line_of_word(text, key) or 1
        if key not in known:
            yield LessonError(file, where, f"unknown lesson {key!r}{suggestion(key, known)}", line)
        for other in needs.get(key, ()):
            if order.get(other, -1) > order[key]:
                problem = f"the lesson {key!r} stands before {other!r}, which it needs; put it behind that one"
                yield LessonError(file, where, problem, line)


def _line_of_word(text: str, word: str, after: int = 0) -> int:
    """Return the line, from 1, of a text in quotes, after so many others with the same words; 0 for none."""
    for found in _WORD.finditer(text):
        if word in (found[1], found[2]):
            if not after:
                return text.count("\n", 0, found.start()) + 1
            after -= 1
    return 0


# --- What lessons need


def amiss(needs: Mapping[str, Iterable[str]], known: Collection[str]) -> dict[str, list[str]]:
    """Return, by lesson, sentences on what is wrong with what it needs: an unknown lesson, or a circle.

    >>> amiss({"a": ["b"], "b": ["c"], "c": ["b"]}, ["a", "b", "c"])["c"]
    ["a circle: 'c' needs 'b', which needs 'c'; nobody could begin, so take one of these away"]
    """
    found: dict[str, list[str]] = {}
    for key, others in needs.items():
        said = [f"unknown lesson {other!r}{suggestion(other, known)}" for other in others if other not in known]
        if way := _way(key, key, needs):
            chain = ", which needs ".join(map(repr, way))
            said.append(f"a circle: {key!r} needs {chain}; nobody could begin, so take one of these away")
        if said:
            found[key] = said
    return found


def sound(needs: Mapping[str, Iterable[str]], known: Collection[str]) -> dict[str, tuple[str, ...]]:
    """Return what each lesson needs, without what does not exist and without circles.

    >>> sound({"a": ["b", "gone"], "b": ["c"], "c": ["b"]}, ["a", "b", "c"])
    {'a': ('b',), 'b': (), 'c': ()}
    """
    return {
        key: tuple(other for other in others if other in known and not _way(other, key, needs))
        for key, others in needs.items()
    }


def _way(start: str, goal: str, needs: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """Return a shortest way, without its start, from a lesson to one that it needs through others; empty for none."""
    ways: list[tuple[str, ...]] = [()]
    seen: set[str] = set()
    for way in ways:  # which grows
        for other in needs.get(way[-1] if way else start, ()):
            if other == goal:
                return (*way, other)
            if other not in seen:
                seen.add(other)
                ways.append((*way, other))
    return ()


T = TypeVar("T", bound=Headed)


def ordered(lessons: Iterable[T]) -> list[T]:
    """Return lessons by the numbers with which their chapters begin, so that 10 comes after 9, and by key."""
    return sorted(lessons, key=lambda lesson: (_numbers(lesson.chapter), lesson.chapter, lesson.key))


def _numbers(chapter: str) -> list[int]:
    number = re.match(r"[\d.]*", chapter)
    return [int(part) for part in re.findall(r"\d{1,9}", number[0] if number else "")]


def by_chapters(lessons: Iterable[Headed]) -> tuple[Chapter, ...]:
    """Return chapters of lessons by what they say themselves; lessons of a chapter follow each other."""
    found: dict[str, list[str]] = {}
    for lesson in lessons:
        found.setdefault(lesson.chapter, []).append(lesson.key)
    return tuple(Chapter(title, "", tuple(keys)) for title, keys in found.items())
