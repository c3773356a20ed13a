"""Courses with the heads of their lessons, read without the lessons themselves, which would take seconds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources.abc import Traversable

from armlab import resources
from armlab.content.as_written import as_written
from armlab.content.course import Chapter, Course, by_chapters, ordered, parse_course, sound
from armlab.content.courses import OF_THE_LAB, CourseFiles
from armlab.content.lesson_folder import Source, Stamp, course_of, lesson_of, sources_of
from armlab.content.lesson_head import Head, head_of
from armlab.errors import ContentError


@cache
def first_heads(count: int) -> tuple[Head, ...]:
    """Return the heads of the first lessons of the lab's own course; fewer where one cannot be read."""
    folder = resources.folder("lessons")
    try:
        source = course_of(folder)
        course = parse_course(OF_THE_LAB, source.read()[0], source.file) if source is not None else None
        files = [lesson_of(folder, key) for key in course.lessons[:count]] if course is not None else []
        return tuple(head_of(file.key, file.read()[0], file.file) for file in files if file is not None)
    except ContentError:
        return ()  # what is wrong is told when all lessons are read


@dataclass(frozen=True)
class Outline:
    """The courses of some folders, and the heads of their lessons.

    Attributes
    ----------
    courses : tuple of Course
        The first is the one that is shown to those who choose none; there always is one.
    heads : mapping of str to Head
    needs : mapping of str to tuple of str
        By lesson, the keys of those it needs, without mistakes.
    places : mapping
        By course, its folder and the text before the names of its files in messages.
    """

    courses: tuple[Course, ...]
    heads: Mapping[str, Head]
    needs: Mapping[str, tuple[str, ...]]
    places: Mapping[str, tuple[Traversable, str]] = field(default_factory=dict)

    @cached_property
    def others(self) -> tuple[Chapter, ...]:
        """The lessons that no course names, by the chapters that they name themselves."""
        named = {key for course in self.courses for key in course.lessons}
        return by_chapters(head for key, head in self.heads.items() if key not in named and head.listed)


class Outlines:
    """The outline of some folders, read again when their files change.

    Parameters
    ----------
    folders : iterable of Traversable
        The first is the lab's own.
    """

    def __init__(self, folders: Iterable[Traversable]) -> None:
        self._folders = [(folder, f"{folder.name}/" if i else "") for i, folder in enumerate(folders)]
        self._files = CourseFiles()
        self._heads: dict[str, tuple[str, Stamp, Head | None]] = {}
        self._outline: Outline | None = None

    def look(self) -> Outline:
        """Return the outline as the files are now; the same one as long as none has changed."""
        found: dict[str, Source] = {}
        for folder, label in self._folders:
            for source in sources_of(folder, label)[0]:
                found.setdefault(source.key, source)
        heads = {key: self._looked_at(source) for key, source in found.items()}
        changed = heads != self._heads
        self._heads = heads
        if self._files.look(self._folders) or changed or self._outline is None:
            self._outline = self._made()
        return self._outline

    def _looked_at(self, source: Source) -> tuple[str, Stamp, Head | None]:
        before = self._heads.get(source.key)
        if before is not None and before[:2] == (source.file, source.stamp):
            return before
        try:
            head = head_of(source.key, source.read()[0], source.file)
            head = as_written(head, "title", "chapter", "can") if source.own else head
        except ContentError:
            head = None
        return source.file, source.stamp, head

    def _made(self) -> Outline:
        there = ordered(head for _, _, head in self._heads.values() if head is not None)
        heads = {head.key: head for head in there}
        needs = sound({key: head.after for key, head in heads.items()}, heads)
        judged, _ = self._files.judged(self._heads, needs)
        listed = {head.key for head in there if head.listed}
        courses = tuple(course for each in judged if (course := each.among(listed)).chapters)
        return Outline(
            courses or (Course("", "All lessons", "", by_chapters(head for head in there if head.listed)),),
            heads,
            needs,
            self._files.places,
        )
