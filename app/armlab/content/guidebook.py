"""The guides to courses: what is written of them in files, and what the lessons say themselves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from importlib.resources.abc import Traversable

from armlab.content.course import Course
from armlab.content.guide import Guide, parse_guide, strange
from armlab.content.lesson_folder import COURSE, Source, Stamp, course_of, guide_of, sources_of
from armlab.content.lesson_mistakes import Named, mistakes_of
from armlab.content.outline import Outline, Outlines
from armlab.content.watched import Watched
from armlab.errors import ContentError


@dataclass(frozen=True)
class Guidebook:
    """The guides to the courses of some folders.

    Attributes
    ----------
    outline : Outline
    guides : mapping of str to Guide
        By the key of the course; a course may have none.
    mistakes : mapping of str to Named
        By lesson.
    problems : mapping of str to tuple of ContentError
        By course, what is wrong with the file of its guide, which then is as it last could be used.
    """

    outline: Outline
    guides: Mapping[str, Guide]
    mistakes: Mapping[str, Named]
    problems: Mapping[str, tuple[ContentError, ...]]


class Guidebooks:
    """The guidebook of some folders, read again when their files change.

    Parameters
    ----------
    folders : iterable of Traversable
        Folders of lessons, of which the first is the lab's own.
    """

    def __init__(self, folders: Iterable[Traversable]) -> None:
        given = list(folders)
        self._folders = [(folder, f"{folder.name}/" if i else "") for i, folder in enumerate(given)]
        self._outlines = Outlines(given)
        self._files: dict[str, Watched[Guide]] = {}
        self._mistakes: dict[str, tuple[str, Stamp, Named]] = {}
        self._book: Guidebook | None = None

    def look(self) -> Guidebook:
        """Return the guidebook as the files are now; the same one as long as none has changed."""
        outline = self._outlines.look()
        files = {key: found for key, place in outline.places.items() if (found := self._file(key, *place))}
        mistakes = self._named()
        same = self._book is not None and outline is self._book.outline
        if not same or files != self._files or mistakes != self._mistakes or self._book is None:
            courses = {course.key: course for course in outline.courses}
            judged = {key: file.judged(partial(_strange, file, courses.get(key))) for key, file in files.items()}
            files = {key: file for key, (file, _) in judged.items()}
            self._book = Guidebook(
                outline,
                {key: file.good for key, file in files.items() if file.good is not None},
                {key: found for key, (_, _, found) in mistakes.items()},
                {key: tuple(errors) for key, (_, errors) in judged.items() if errors},
            )
        self._files, self._mistakes = files, mistakes
        return self._book

    def _file(self, key: str, folder: Traversable, label: str) -> Watched[Guide] | None:
        source = guide_of(folder, label)
        return (
            None if source is None else Watched.read(source, self._files.get(key), partial(parse_guide, own=source.own))
        )

    def _named(self) -> dict[str, tuple[str, Stamp, Named]]:
        """Return the mistakes that lessons name; those of a file that cannot be read are as they were before."""
        found: dict[str, Source] = {}
        for folder, label in self._folders:
            for source in sources_of(folder, label)[0]:
                found.setdefault(source.key, source)
        named = {}
        for key, source in found.items():
            before = self._mistakes.get(key, ("", (), Named()))
            if before[:2] != (source.file, source.stamp):
                try:
                    before = source.file, source.stamp, mistakes_of(key, source.read()[0], source.file, source.own)
                except ContentError:  # which the map of lessons and `armlab lesson check` tell
                    before = source.file, source.stamp, before[2]
            named[key] = before
        return named


def guide_in(folder: Traversable, course: Course | None) -> tuple[Guide | None, str, list[ContentError]]:
    """Return the guide of a folder, its text, and what is wrong with it.

    Parameters
    ----------
    folder : Traversable
    course : Course or None
        The course of the folder, where it has one that can be used.

    Returns
    -------
    guide : Guide or None
        None where there is none, or none that can be read.
    text : str
    problems : list of ContentError
    """
    source = guide_of(folder)
    if source is None:
        return None, "", []
    if course_of(folder) is None:
        problem = f"a guide follows the chapters of a course; put {COURSE} beside it"
        return None, "", [ContentError(source.file, "", problem)]
    file = Watched.read(source, None, parse_guide)
    return file.content, file.text, file.judged(partial(_strange, file, course))[1]


def _strange(file: Watched[Guide], course: Course | None, guide: Guide, text: str) -> Iterable[ContentError]:
    """Return what is wrong with a guide as that of a course; nothing where there is no course that can be used."""
    return () if course is None else strange(guide, course, text, file.source.file)
