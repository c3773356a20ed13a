"""The lessons and assignments that a person has loaded, and the course that is being put in order: nobody else's.

They go along to every place, and into no link.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar, Self

from armlab.content.as_written import AsWritten
from armlab.content.assignment import amiss
from armlab.content.course import Chapter, Course, parse_course
from armlab.content.courses import kept
from armlab.content.held import HeldAssignment, HeldLesson, hold_assignment, hold_lesson
from armlab.content.lesson import Lesson
from armlab.content.lesson_folder import COURSE
from armlab.content.lessons import lessons
from armlab.content.robots import Robot
from armlab.content.upload import ASSIGNMENT, LESSON_KIND, MOST_TEXT, Upload
from armlab.errors import ContentError, InputError
from armlab.session.state import Json, Part, PartType

MOST_FILES = 12
MOST_SIZE = 600_000
"""Largest size of all files together, in characters."""

Held = HeldLesson | HeldAssignment


@dataclass(frozen=True)
class OwnLessons(Part):
    """The files that one person has loaded.

    Attributes
    ----------
    files : tuple of Upload
        Lessons, then assignments; no two of a kind have one name.
    held : mapping of str to HeldLesson or HeldAssignment
        By file, what can be used: under its key it can be opened as long as it is here.
    problems : mapping of str to ContentError or InputError
        By file, why the others cannot be used.
    course : Course or None
        The course that is being put in order.
    """

    key: ClassVar[str] = "own_lessons"
    called: ClassVar[str] = "the files you have loaded"
    kept_by_undo: ClassVar[bool] = True

    files: tuple[Upload, ...] = ()
    held: Mapping[str, Held] = field(default_factory=lambda: MappingProxyType({}))
    problems: Mapping[str, ContentError | InputError] = field(default_factory=lambda: MappingProxyType({}))
    course: Course | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part with nothing in it."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def having(self, files: tuple[Upload, ...]) -> Self:
        """Return the part with these files in place of the present ones.

        Raises
        ------
        InputError
            They are too many, or too large together.
        """
        if len(files) > MOST_FILES:
            raise InputError(f"expected at most {MOST_FILES} files; remove one that you do not need any more")
        size = sum(each.size for each in files)
        if size > MOST_SIZE:
            raise InputError(f"expected at most {MOST_SIZE} characters in all files together, got {size}; remove one")
        ordered = tuple(sorted(files, key=lambda each: (each.kind != LESSON_KIND, each.name)))
        held: dict[str, Held] = {}
        problems: dict[str, ContentError | InputError] = {}
        for upload in ordered:
            try:
                held[upload.file] = _held(upload, held)
            except (ContentError, InputError) as error:
                problems[upload.file] = error
        return replace(self, files=ordered, held=MappingProxyType(held), problems=MappingProxyType(problems))

    @property
    def lessons(self) -> dict[str, Lesson]:
        """The lessons among them that can be used, by the names under which a course or an assignment has them."""
        return {each.upload.name: each.lesson for each in self.held.values() if isinstance(each, HeldLesson)}

    def holds(self, key: str) -> bool:
        """Return whether a lesson or an assignment with this key is one of them."""
        return any(key_of(each) == key for each in self.held.values())

    def to_json(self) -> Json:
        """Return the files and the course as JSON."""
        files = [[each.kind, each.name, each.text, each.pictures and dict(each.pictures)] for each in self.files]
        if not files and self.course is None:
            return None
        course = self.course and {
            "title": self.course.title,
            "about": self.course.about,
            **({} if isinstance(self.course.title, AsWritten) else {"own": False}),
            "chapters": [[each.title, each.about, list(each.lessons)] for each in self.course.chapters],
        }
        return {"files": files, "course": course}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; a file that cannot be used any more stays, with the reason why not."""
        if data is None:
            return cls()
        files = tuple(
            Upload(str(kind), str(name), str(text), None if pictures is None else MappingProxyType(pictures))
            for kind, name, text, pictures in data["files"]
        )
        return cls(course=_course_of(data["course"])).having(files)


PART = PartType(OwnLessons, order=93)


def key_of(held: Held) -> str:
    """Return the key under which it can be opened."""
    return held.lesson.key if isinstance(held, HeldLesson) else held.assignment.key


def course_in(upload: Upload) -> Course:
    """Return the course of a file.

    Raises
    ------
    ContentError
        It cannot be used.
    """
    if len(upload.text) > MOST_TEXT:
        raise InputError(f"{COURSE}: expected at most {MOST_TEXT} characters, got {len(upload.text)}")
    return kept(parse_course("", upload.text, upload.file))


def _course_of(data: Json) -> Course | None:
    if data is None:
        return None
    chapters = tuple(Chapter(str(title), str(about), tuple(map(str, keys))) for title, about, keys in data["chapters"])
    course = Course("", str(data["title"]), str(data["about"]), chapters)
    return kept(course) if data.get("own", True) else course


def _held(upload: Upload, others: Mapping[str, Held]) -> Held:
    """Return what an upload holds; an assignment may have tasks with the lessons among others."""
    if upload.kind == LESSON_KIND:
        return hold_lesson(upload)
    if upload.kind != ASSIGNMENT:
        raise InputError(f"{upload.file}: expected a lesson or an assignment, got {upload.kind!r}")
    own = {each.upload.name: each.lesson for each in others.values() if isinstance(each, HeldLesson)}
    held = hold_assignment(upload, {name: lesson.key for name, lesson in own.items()})
    there = lessons()
    # What is in no list stays out of sight for whoever names it in a file of their own, too.
    usable = {**{lesson.key: lesson for lesson in there.listed}, **{lesson.key: lesson for lesson in own.values()}}
    for problem in amiss(held.assignment, upload.text, usable, there.broken):
        raise problem
    return held
