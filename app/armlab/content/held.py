"""Lessons and assignments that one person has loaded: nobody else sees them, and they last as long as they are held.

Their keys have a hyphen, which no file has, and then digits of their content: who has not got the text cannot name it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from weakref import WeakValueDictionary

from armlab.content.as_written import as_written
from armlab.content.assignment import Assignment, parse_assignment
from armlab.content.lesson import Lesson
from armlab.content.lesson_file import parse_lesson
from armlab.content.names import MARK, named
from armlab.content.upload import Upload

_DIGITS = 20


@dataclass(frozen=True, eq=False)
class HeldLesson:
    """A lesson that is held; ``upload`` is its file."""

    lesson: Lesson
    upload: Upload


@dataclass(frozen=True, eq=False)
class HeldAssignment:
    """An assignment that is held."""

    assignment: Assignment


_LESSONS: WeakValueDictionary[str, HeldLesson] = WeakValueDictionary()
_ASSIGNMENTS: WeakValueDictionary[str, HeldAssignment] = WeakValueDictionary()


def hold_lesson(upload: Upload) -> HeldLesson:
    """Return a lesson, which can be opened under its key as long as somebody has what is returned.

    Raises
    ------
    ContentError
        It cannot be used.
    """
    pictures = [f"{name}\0{address}" for name, address in sorted((upload.pictures or {}).items())]
    key = _key(upload.name, upload.text, *pictures)
    there = _LESSONS.get(key)
    if there is None:
        there = HeldLesson(_parsed(upload, key), upload)
        there = _LESSONS.setdefault(key, there)
    return there


def hold_assignment(upload: Upload, names: Mapping[str, str]) -> HeldAssignment:
    """Return an assignment in the same way.

    Parameters
    ----------
    upload : Upload
    names : mapping of str to str
        By the names of lessons in the file, the keys of those that are held; others are those of the lab.

    Raises
    ------
    ContentError
        It cannot be used.
    """
    found = as_written(parse_assignment(upload.name, upload.text, upload.file), "title", "about")
    tasks = tuple(replace(task, lesson=names.get(task.lesson, task.lesson)) for task in found.tasks)
    return _held(replace(found, tasks=tasks), upload.name, upload.text)


def hold_without_dates(found: Assignment) -> HeldAssignment:
    """Return an assignment, held, that can be begun at any time."""
    return _held(replace(found, opens=None, due=None, closes=None), named(found.key), found.digest)


def _held(found: Assignment, name: str, text: str) -> HeldAssignment:
    key = _key(name, text, repr((found.lessons, found.opens, found.due, found.closes)))
    there = HeldAssignment(replace(found, key=key))
    return _ASSIGNMENTS.setdefault(key, there)


def held_lesson(key: str) -> HeldLesson | None:
    """Return a lesson that is held; None where there is none."""
    return _LESSONS.get(key) if MARK in key else None


def held_assignment(key: str) -> Assignment | None:
    """Return an assignment that is held; None where there is none."""
    there = _ASSIGNMENTS.get(key) if MARK in key else None
    return None if there is None else there.assignment


def is_held(key: str) -> bool:
    """Return whether a key is one of those, held or not."""
    return MARK in key


def _parsed(upload: Upload, key: str) -> Lesson:
    return replace(parse_lesson(upload.name, upload.text, upload.file, pictures=upload.pictures, own=True), key=key)


def _key(name: str, *parts: str) -> str:
    found = hashlib.sha256("\0\0".join((name, *parts)).encode("utf-8", "surrogatepass"))
    return f"{name}{MARK}{found.hexdigest()[:_DIGITS]}"
