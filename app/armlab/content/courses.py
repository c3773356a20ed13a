"""The files of courses: one in each folder of lessons, if any, read again when it changes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from importlib.resources.abc import Traversable

from armlab.content.course import Course, misplaced, parse_course
from armlab.content.lesson_folder import Source, course_of
from armlab.errors import ContentError

OF_THE_LAB = "lab"
"""Key of the lab's own course."""


@dataclass(frozen=True)
class _File:
    """The file of a course as it is, and the course as it last could be used."""

    source: Source
    text: str
    course: Course | None
    problem: ContentError | None
    good: Course | None = None


class CourseFiles:
    """The files of courses of some folders, of which the first is the lab's own.

    A file with a mistake changes nothing: the course stays as it was before.

    Attributes
    ----------
    places : dict
        By key of the course, its folder and the text before the names of its files in messages.
    """

    def __init__(self) -> None:
        self._files: dict[str, _File] = {}
        self.places: dict[str, tuple[Traversable, str]] = {}

    def look(self, folders: Iterable[tuple[Traversable, str]]) -> bool:
        """Read the files that have changed; return whether any has.

        Parameters
        ----------
        folders : iterable of (Traversable, str)
            Folders, and the text before the names of their files in messages.
        """
        found: dict[str, _File] = {}
        self.places = {}
        for i, (folder, label) in enumerate(folders):
            source = course_of(folder, label)
            if source is None:
                continue
            key = _free(source.key, {OF_THE_LAB, *found}) if i else OF_THE_LAB
            self.places[key] = folder, label
            before = self._files.get(key)
            if before is not None and _same(before.source, source):
                found[key] = before
            else:
                found[key] = _read(key, source, before.good if before is not None else None)
        changed = list(found.items()) != list(self._files.items())
        self._files = found
        return changed

    def judged(
        self, known: Collection[str], needs: Mapping[str, Iterable[str]]
    ) -> tuple[tuple[Course, ...], list[ContentError]]:
        """Return the courses, teachers' own before that of the lab, and what is wrong with their files.

        Parameters
        ----------
        known : collection of str
            Keys of all lessons that have a file.
        needs : mapping of str to iterable of str
            Keys of the lessons that each one needs.
        """
        problems: list[ContentError] = []
        judged: dict[str, _File] = {}
        for key, file in self._files.items():
            wrong = [file.problem] if file.problem is not None else []
            if file.course is not None:
                wrong += misplaced(file.course, file.text, file.source.file, known, needs)
            problems += wrong
            judged[key] = file if wrong else replace(file, good=file.course)
        self._files = judged
        good = [file.good for file in self._files.values() if file.good is not None]
        own = [course for course in good if course.key != OF_THE_LAB]
        return (*own, *(course for course in good if course.key == OF_THE_LAB)), problems


def mistakes_in(folder: Traversable, known: Collection[str], needs: Mapping[str, Iterable[str]]) -> list[ContentError]:
    """Return what is wrong with the file of the course of a folder, if it has one; see `CourseFiles.judged`."""
    files = CourseFiles()
    files.look([(folder, "")])
    return files.judged(known, needs)[1]


def _free(key: str, taken: Collection[str]) -> str:
    """Return a key that no other course has."""
    name, number = key, 1
    while name in taken:
        number += 1
        name = f"{key}_{number}"
    return name


def _same(one: Source, other: Source) -> bool:
    return (one.file, one.stamp) == (other.file, other.stamp)


def _read(key: str, source: Source, good: Course | None) -> _File:
    text = ""
    try:
        text, _ = source.read()
        return _File(source, text, parse_course(key, text, source.file), None, good)
    except ContentError as error:
        return _File(source, text, None, error, good)
