"""Another order of a course: a lesson moved, left out or put in; the file of it, and what is wrong with it."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace

from armlab.content.course import Chapter, Course, misplaced, parse_course
from armlab.content.lesson_folder import COURSE
from armlab.errors import ContentError, InputError


def moved(course: Course, key: str, by: int) -> Course:
    """Return the course with a lesson one place further, at the end of a chapter in the next one.

    A chapter of which nothing is left goes. At the end of the course nothing changes.

    Examples
    --------
    >>> one, two = Chapter("1", "", ("a", "b")), Chapter("2", "", ("c",))
    >>> [chapter.lessons for chapter in moved(Course("", "", "", (one, two)), "b", 1).chapters]
    [('a',), ('b', 'c')]
    """
    i, k = _place(course, key)
    rest = [*course.chapters[i].lessons]
    rest.remove(key)
    lists = [list(chapter.lessons) for chapter in course.chapters]
    lists[i] = rest
    to = k + by
    if 0 <= to <= len(rest):
        lists[i].insert(to, key)
    elif not 0 <= i + by < len(lists):
        return course
    elif by > 0:
        lists[i + 1].insert(0, key)
    else:
        lists[i - 1].append(key)
    return _with(course, lists)


def left_out(course: Course, key: str) -> Course:
    """Return the course without a lesson.

    Raises
    ------
    InputError
        It is the only one.
    """
    _place(course, key)
    if len(course.lessons) == 1:
        raise InputError("A course has at least one lesson.")
    return _with(course, [[each for each in chapter.lessons if each != key] for chapter in course.chapters])


def put_back(course: Course, key: str) -> Course:
    """Return the course with a lesson put in at its end."""
    if key in course.lessons:
        return course
    lists = [list(chapter.lessons) for chapter in course.chapters]
    return _with(course, [*lists[:-1], [*lists[-1], key]])


def course_text(course: Course) -> str:
    """Return the file of a course, which `parse_course` reads as the same."""
    lines = [f"title = {_text(course.title)}", *([f"about = {_text(course.about)}"] if course.about else [])]
    for chapter in course.chapters:
        lines += ["", "[[chapters]]", f"title = {_text(chapter.title)}"]
        lines += [f"about = {_text(chapter.about)}"] if chapter.about else []
        lines += ["lessons = [", *(f"    {_text(key)}," for key in chapter.lessons), "]"]
    return "\n".join(lines) + "\n"


def mistakes(
    course: Course, known: Collection[str], needs: Mapping[str, Iterable[str]], file: str = COURSE
) -> list[ContentError]:
    """Return what would be wrong with the file of a course: lessons before what they need, or unknown ones."""
    text = course_text(course)
    try:
        return [*misplaced(parse_course("", text, file), text, file, known, needs)]
    except ContentError as error:
        return [error]


def _place(course: Course, key: str) -> tuple[int, int]:
    """Return the chapter of a lesson and its place there, from 0."""
    for i, chapter in enumerate(course.chapters):
        if key in chapter.lessons:
            return i, chapter.lessons.index(key)
    raise InputError(f"The course has no lesson {key!r}.")


def _with(course: Course, lists: Iterable[Iterable[str]]) -> Course:
    chapters = [replace(each, lessons=tuple(keys)) for each, keys in zip(course.chapters, lists, strict=True)]
    return replace(course, chapters=tuple(chapter for chapter in chapters if chapter.lessons))


def _text(text: str) -> str:
    """Return a basic string of TOML; it is escaped as in JSON, with DEL escaped as well."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


__all__ = ["Chapter", "course_text", "left_out", "mistakes", "moved", "put_back"]
