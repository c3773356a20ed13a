"""The files of courses: one in each folder of lessons, if any, read again when it changes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from functools import partial
from importlib.resources.abc import Traversable

from armlab.content.as_written import as_written
from armlab.content.course import Course, misplaced, parse_course
from armlab.content.lesson_folder import Source, course_of
from armlab.content.watched import Watched
from armlab.errors import ContentError

OF_THE_LAB = "lab"
"""Key of the lab's own course."""


class CourseFiles:
    """The files of courses of some folders, of which the first is the lab's own.

    A file with a mistake changes nothing: the course stays as it was before.

    Attributes
    ----------
    places : dict
        By key of the course, its folder and the text before the names of its files in messages.
    """

    def __init__(self) -> None:
        self._files: dict[str, Watched[Course]] = {}
        self.places: dict[str, tuple[Traversable, str]] = {}

    def look(self, folders: Iterable[tuple[Traversable, str]]) -> bool:
        """Read the files that have changed; return whether any has.

        Parameters
        ----------
        folders : iterable of (Traversable, str)
            Folders, and the text before the names of their files in messages.
        """
        found: dict[str, Watched[Course]] = {}
        self.places = {}
        for i, (folder, label) in enumerate(folders):
            source = course_of(folder, label)
            if source is None:
                continue
            key = _free(source.key, {OF_THE_LAB, *found}) if i else OF_THE_LAB
            self.places[key] = folder, label
            found[key] = Watched.read(source, self._files.get(key), partial(_parsed, key, source))
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
        judged: dict[str, Watched[Course]] = {}
        for key, file in self._files.items():
            judged[key], wrong = file.judged(partial(_misplaced, file.source.file, known, needs))
            problems += wrong
        self._files = judged
        good = [file.good for file in self._files.values() if file.good is not None]
        own = [course for course in good if course.key != OF_THE_LAB]
        return (*own, *(course for course in good if course.key == OF_THE_LAB)), problems


def kept(course: Course) -> Course:
    """Return a teacher's own course, whose titles are not translated."""
    chapters = tuple(as_written(chapter, "title", "about") for chapter in course.chapters)
    return as_written(replace(course, chapters=chapters), "title", "about")


def mistakes_in(folder: Traversable, known: Collection[str], needs: Mapping[str, Iterable[str]]) -> list[ContentError]:
    """Return what is wrong with the file of the course of a folder, if it has one; see `CourseFiles.judged`."""
    files = CourseFiles()
    files.look([(folder, "")])
    return files.judged(known, needs)[1]


def _parsed(key: str, source: Source, text: str, file: str) -> Course:
    course = parse_course(key, text, file)
    return kept(course) if source.own else course


def _free(key: str, taken: Collection[str]) -> str:
    """Return a key that no other course has."""
    name, number = key, 1
    while name in taken:
        number += 1
        name = f"{key}_{number}"
    return name


def _misplaced(
    file: str, known: Collection[str], needs: Mapping[str, Iterable[str]], course: Course, text: str
) -> Iterable[ContentError]:
    return misplaced(course, text, file, known, needs)
