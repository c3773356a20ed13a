"""All lessons and courses: those of the lab and of teachers' folders, read again when their files change."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources.abc import Traversable
from pathlib import Path
from threading import Event, Lock, RLock

from armlab import resources
from armlab.content.assignment import Assignment
from armlab.content.assignments import AssignmentFiles
from armlab.content.course import Chapter, Course, amiss, by_chapters, ordered, sound
from armlab.content.courses import CourseFiles
from armlab.content.folder import Folder
from armlab.content.held import held_assignment, held_lesson
from armlab.content.lesson import Lesson as Lesson
from armlab.content.lesson import Step as Step
from armlab.content.lesson_file import parse_lesson as parse_lesson
from armlab.content.lesson_folder import Source, Stamp, glance, lesson_of, sources_of
from armlab.content.lesson_head import front_line
from armlab.content.lesson_lines import LessonError
from armlab.content.lesson_reading import Good, Reading, Readings
from armlab.content.robots import KEY, Catalogue
from armlab.errors import ContentError, InputError, UnknownName
from armlab.registry import known_name

_READING = Lock()

_READINGS = Readings()
"""The lab's lessons that have been read, alone or with all others."""

_NEEDED = Event()
"""Set when somebody waits for the lessons."""

GIVING_WAY = 1.0
"""Pause after each lesson that is read before anybody needs it, in times of what its reading took."""

PROBLEM_SETS = "problem_sets"
"""Folder of the lab's own assignments and their lessons, within that of its lessons."""


@dataclass(frozen=True)
class Lessons(Folder[Lesson]):
    """All lessons at one time.

    Attributes
    ----------
    gone : dict
        Lessons whose files were taken away: those who are in one can go on.
    broken : dict
        Problems, by key, of files that never were readable.
    courses : tuple of Course
        Those of teachers' folders before that of the lab.
    needs : dict
        By lesson, the keys of those it needs, without mistakes.
    amiss : dict
        By lesson, problems of what it needs; it can be used all the same.
    assignments : dict
    assignments_gone : dict
        Those whose files were taken away: those who are in one can go on.
    """

    kind = "lesson"
    ending = ".md"

    gone: Mapping[str, Lesson] = field(default_factory=dict)
    broken: Mapping[str, ContentError] = field(default_factory=dict)
    courses: tuple[Course, ...] = ()
    needs: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    amiss: Mapping[str, tuple[LessonError, ...]] = field(default_factory=dict)
    assignments: Mapping[str, Assignment] = field(default_factory=dict)
    assignments_gone: Mapping[str, Assignment] = field(default_factory=dict)

    @property
    def lessons(self) -> dict[str, Lesson]:
        """The lessons by key, in the order of their chapters."""
        return self.found

    def course(self, key: str = "") -> Course:
        """Return the course with this key or, where there is none, the first; without any, one of all chapters."""
        return next((each for each in self.courses if each.key == key), self._first)

    @cached_property
    def _first(self) -> Course:
        chapters = by_chapters(self.listed)
        return self.courses[0] if self.courses else Course("", "All lessons", "", chapters)

    @cached_property
    def others(self) -> tuple[Chapter, ...]:
        """The lessons that no course names, by the chapters that they name themselves."""
        named = {key for course in self.courses or (self._first,) for key in course.lessons}
        return by_chapters(lesson for lesson in self.listed if lesson.key not in named)

    @property
    def listed(self) -> list[Lesson]:
        """The lessons that can be opened by themselves, in the order of their chapters."""
        return [lesson for lesson in self.found.values() if lesson.listed]

    def assignment(self, key: str) -> Assignment:
        """Return an assignment, even a deleted one, or one that is held; the error lists the available ones."""
        held = held_assignment(key)
        if held is not None:
            return held
        if key not in self.assignments and key in self.assignments_gone:
            return self.assignments_gone[key]
        known_name("assignment", key, self.assignments)
        return self.assignments[key]

    def has(self, key: str) -> bool:
        """Return whether there is a lesson with this key that can be used."""
        return key in self.found or held_lesson(key) is not None

    def has_assignment(self, key: str) -> bool:
        """Return whether there is an assignment with this key."""
        return key in self.assignments or held_assignment(key) is not None

    def chapters(self, key: str = "") -> tuple[Chapter, ...]:
        """Return the chapters of a course, and behind them those of `others`."""
        return (*self.course(key).chapters, *self.others)

    def __getitem__(self, key: str) -> Lesson:
        """Return a lesson, even a deleted one or one that is held.

        The error lists the available ones, or tells what is wrong with it.
        """
        held = held_lesson(key)
        if held is not None:
            return held.lesson
        if key not in self.found and key in self.gone:
            return self.gone[key]
        if key not in self.found and key in self.broken:
            raise self.broken[key]
        if key not in self.found:
            raise UnknownName(self.kind, key, [lesson.key for lesson in self.listed])
        return super().__getitem__(key)


class Library:
    """Folders of lessons. A broken file is reported and disturbs nothing else.

    Safe to use from several threads.

    Parameters
    ----------
    folders : iterable of Traversable
        The first is the lab's own.
    catalogue : Catalogue, optional
        The robots there are; those of the lab when left out.
    readings : Readings, optional
        What has been read of them already, and where it is kept what is read.
    """

    def __init__(
        self,
        folders: Iterable[Traversable],
        catalogue: Catalogue | None = None,
        readings: Readings | None = None,
    ) -> None:
        self._readings = Readings(catalogue) if readings is None else readings
        self._folders: list[tuple[Traversable, str]] = []
        self._lock = RLock()
        self._entries: dict[str, Reading] = {}
        self._good: dict[str, Good] = {}
        self._courses, self._assignments = CourseFiles(), AssignmentFiles()
        self._said: list[str] = []  # problems of the folders themselves
        self._seen: list[Stamp | None] = []
        self._lessons = Lessons({}, ())
        self._folders += _labelled(folders)
        self.changed()

    @property
    def lessons(self) -> Lessons:
        """All lessons in their variant 0, as last read."""
        return self._lessons

    def lesson(self, key: str, variant: int = 0) -> Lesson:
        """Return a lesson with the values of a variant.

        Raises
        ------
        UnknownName
            There is no such lesson.
        ContentError
            Its file, or this variant of it, cannot be used.
        """
        first, held = self._lessons[key], held_lesson(key)
        if variant == 0 or not first.varies:
            return first
        # Without the lock, which is held while files are looked at: the page waits for this.
        good = self._good[key] if held is None else Good(first, held.upload.text, held.upload.pictures)
        return self._readings.variant(key, good, variant)

    def kept_lesson(self, key: str, variant: int = 0) -> Lesson:
        """Return a lesson for somebody who is in it: a variant that has come to be broken stays as it last was.

        Where nobody has seen it yet, variant 0 stands for it.

        Raises
        ------
        UnknownName
            There is no such lesson.
        """
        try:
            return self.lesson(key, variant)
        except ContentError:
            return self._readings.last(key, variant) or self._lessons[key]

    def add_folder(self, path: Path) -> frozenset[str]:
        """Add a teacher's folder of lessons and return the keys that came with it; none replaces one there is.

        Raises
        ------
        InputError
            It is no folder.
        """
        folder = Path(path).resolve()
        if not folder.is_dir():
            raise InputError(f"lessons: expected a folder, got {str(path)!r}")
        with self._lock:
            if not any(isinstance(each, Path) and each.resolve() == folder for each, _ in self._folders):
                self._folders.append((folder, f"{folder.name}/"))
            return self.changed()

    def changed(self) -> frozenset[str]:
        """Look at the files again, read those that changed, and return the keys of these lessons.

        A file that has become broken is listed as a problem and keeps the lesson or the course it last was. Nothing is
        read when no file has another time or size.
        """
        with self._lock:
            # Looked at first: what changes while the files are read differs at the next look.
            seen = [glance(folder) for folder, _ in self._folders]
            if seen == self._seen and None not in seen:
                return frozenset()
            found: dict[str, Reading] = {}
            problems: list[ContentError] = []
            changed: set[str] = set()
            for source in self._sources(problems):
                entry = self._readings.read(source)
                if entry.good is not None:
                    self._good[source.key] = entry.good
                found[source.key] = entry
                if entry.differs(self._entries.get(source.key)):
                    changed.add(source.key)
            changed |= self._entries.keys() - found.keys()
            self._entries = found
            others = self._courses.look(self._folders), self._assignments.look(self._folders)
            if changed or any(others) or [str(each) for each in problems] != self._said:
                self._said = [str(each) for each in problems]
                self._lessons = self._listed(problems)
            self._seen = seen
            return frozenset(changed)

    def _sources(self, problems: list[ContentError]) -> list[Source]:
        """Return the lessons to read; of two with the same name the first."""
        chosen: dict[str, Source] = {}
        for folder, label in self._folders:
            sources, wrong = sources_of(folder, label)
            problems += wrong
            for source in sources:
                other = chosen.setdefault(source.key, source)
                if other is not source:
                    place = f"{other.file}{'' if '/' in other.file else ' of the lab'}"
                    problem = f"the lesson {source.key!r} is there already, in {place}; rename this one"
                    problems.append(ContentError(source.file, "", problem))
        return list(chosen.values())

    def _listed(self, problems: list[ContentError]) -> Lessons:
        there = {key: good.lesson for key, good in self._good.items() if key in self._entries}
        lessons = {lesson.key: lesson for lesson in ordered(there.values())}
        needed = {key: lesson.after for key, lesson in lessons.items()}
        wrong = {key: tuple(self._needs(key, said)) for key, said in amiss(needed, self._entries).items()}
        needs = sound(needed, lessons)
        courses, misplaced = self._courses.judged(self._entries, needs)
        problems += [entry.problem for entry in self._entries.values() if entry.problem is not None]
        assignments, unfit = self._assignments.judged(lessons, self._entries)
        problems += [*(error for errors in wrong.values() for error in errors), *misplaced, *unfit]
        listed = {key for key, lesson in lessons.items() if lesson.listed}
        return Lessons(
            lessons,
            tuple(problems),
            {key: good.lesson for key, good in self._good.items() if key not in there},
            {key: entry.problem for key, entry in self._entries.items() if entry.problem and key not in there},
            tuple(course for each in courses if (course := each.among(listed)).chapters),
            needs,
            wrong,
            assignments,
            self._assignments.gone,
        )

    def _needs(self, key: str, said: Iterable[str]) -> Iterator[LessonError]:
        good = self._good[key]
        return (LessonError(good.lesson.file, "after", each, front_line(good.text, "after")) for each in said)


def library() -> Library:
    """Return the library of this process, which begins with the lessons that come with the lab.

    The first call reads them all, which takes seconds; others wait for it.
    """
    hurry()
    with _READING:
        return _library()


def hurry() -> None:
    """Let the lessons be read without pauses from now on."""
    _NEEDED.set()


def read_unhurried(given_up: Event) -> bool:
    """Read all lessons of the lab, if nobody has yet, with pauses in which arms move; none once somebody waits.

    Returns False when it is given up meanwhile; whoever needs the lessons then reads the rest.
    """
    with _READING:
        if not _library.cache_info().currsize:
            for source in (source for place in _labelled(folders_of_the_lab()) for source in sources_of(*place)[0]):
                if given_up.is_set():
                    return False
                began = time.thread_time()
                _READINGS.read(source)
                _NEEDED.wait(GIVING_WAY * (time.thread_time() - began))
        _library()
    return True


@cache
def _library() -> Library:
    return Library(folders_of_the_lab(), readings=_READINGS)


def _labelled(folders: Iterable[Traversable]) -> list[tuple[Traversable, str]]:
    """Return each folder with what stands before its files in messages."""
    return [(folder, f"{folder.name}/" if i else "") for i, folder in enumerate(folders)]


def folders_of_the_lab() -> list[Traversable]:
    """Return the lab's own folders: that of its lessons, and in it that of its assignments."""
    lessons = resources.folder("lessons")
    return [lessons, lessons.joinpath(PROBLEM_SETS)]


def lessons() -> Lessons:
    """Return all lessons in their variant 0."""
    return library().lessons


def lessons_read() -> Lessons | None:
    """Return all lessons as last read, or None while nobody has needed any."""
    return lessons() if _library.cache_info().currsize else None


def lesson(key: str, variant: int = 0) -> Lesson:
    """Return a lesson with the values of a variant; see `Library.lesson`.

    While not all lessons of the lab have been read, one of them is read alone: nobody waits seconds for the others.
    """
    good = None if _library.cache_info().currsize else _alone(key)
    return library().lesson(key, variant) if good is None else _READINGS.variant(key, good, variant)


def kept_lesson(key: str, variant: int = 0) -> Lesson:
    """Return a lesson for somebody who is in it; see `Library.kept_lesson`."""
    try:
        return lesson(key, variant)
    except ContentError:
        return library().kept_lesson(key, variant)


def _alone(key: str) -> Good | None:
    """Return a lesson of the lab without any other; None for what is none or cannot be used, as all together tell."""
    known = _READINGS.known(key)
    if known is not None or not KEY.match(key):
        return known
    source = lesson_of(folders_of_the_lab()[0], key)
    return None if source is None else _READINGS.read(source).good


def add_folder(path: Path) -> frozenset[str]:
    """Add a teacher's folder of lessons; see `Library.add_folder`."""
    return library().add_folder(path)


def changed() -> frozenset[str]:
    """Check the files again and return the keys of changed lessons; see `Library.changed`."""
    return library().changed()
