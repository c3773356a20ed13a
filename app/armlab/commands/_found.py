"""Which lessons are meant by what was typed: a name, a file or a folder; and their files."""

from __future__ import annotations

import argparse
import os
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path

from armlab.content.assignment import Assignment, amiss, parse_assignment
from armlab.content.assignments import assignments_in
from armlab.content.courses import mistakes_in
from armlab.content.lesson_file import digest_of
from armlab.content.lesson_folder import COURSE, ENDING, GUIDE, LESSON, OF_ASSIGNMENT, Source, sources_of
from armlab.content.lessons import Lesson, Lessons, add_folder, folders_of_the_lab, lessons
from armlab.content.robots import KEY
from armlab.errors import ContentError, InputError
from armlab.teaching.assignment_commands import refuse_unknown_pages

README = "readme.md"


@dataclass(frozen=True)
class Found:
    """A lesson that was typed.

    Attributes
    ----------
    key : str
    file : str
        Its file, as a person can open it.
    source : Source
    """

    key: str
    file: str
    source: Source

    def text(self) -> str:
        """Return the text of its file.

        Raises
        ------
        ContentError
            It cannot be read.
        """
        return self.source.read()[0]

    def lesson(self) -> Lesson:
        """Return the lesson, variant 0.

        Raises
        ------
        ContentError
            It cannot be used, or another lesson has its name.
        """
        digest = digest_of(*self.source.read())
        lesson = lessons()[self.key]
        if lesson.digest != digest:
            raise ContentError(self.file, "", f"there is another lesson {self.key!r}, {lesson.file}; rename this one")
        return lesson


class Place:
    """Where lessons are looked for: in the lab, in the folders given, and in those of the files typed.

    Parameters
    ----------
    folders : iterable of Path

    Raises
    ------
    InputError
        One is no folder.
    """

    def __init__(self, folders: Iterable[Path] = ()) -> None:
        self._folders: list[Traversable] = folders_of_the_lab()
        self._problems: list[str] = []
        self._looked_into: dict[str, Traversable] = {}
        for folder in folders:
            add_folder(folder)
            self._folders.append(folder)

    def all(self) -> list[Found]:
        """Return all lessons of the lab and of the folders given."""
        return [found for folder in self._folders for found in self._in(folder)]

    def one(self, typed: str) -> Found:
        """Return the lesson that is meant.

        Raises
        ------
        UnknownName, InputError, ContentError
        """
        found = self.some(typed)
        if len(found) > 1:
            names = ", ".join(each.key for each in found)
            raise InputError(f"{typed}: expected one lesson, got a folder of {len(found)}: {names}")
        return found[0]

    def some(self, typed: str) -> list[Found]:
        """Return the lesson that is meant, or all lessons of a folder; at least one.

        Raises
        ------
        UnknownName, InputError, ContentError
        """
        known = [found for found in self.all() if found.key == typed]
        if known:
            return known[:1]
        path = Path(typed)
        if not path.exists():
            if typed.endswith(ENDING) or not KEY.match(typed):
                raise InputError(f"{typed}: there is no such lesson, file or folder")
            lessons()[typed]  # says which names there are
        return self._at(typed, Path(os.path.abspath(typed)))

    def assignment(self, typed: str) -> Assignment | None:
        """Return the assignment that is meant; None where a lesson is.

        Raises
        ------
        InputError
            It is a file that is not there, or another assignment has its name.
        ContentError
            It cannot be used.
        """
        if not typed.endswith(OF_ASSIGNMENT):
            return None if typed in lessons().lessons else lessons().assignments.get(typed)
        path = Path(os.path.abspath(typed))
        if not path.is_file():
            raise InputError(f"{typed}: there is no such file")
        if path.name in (COURSE, GUIDE):
            what = "course" if path.name == COURSE else "guide to a course"
            raise InputError(f"{typed}: this is the file of a {what}; expected an assignment, NAME{OF_ASSIGNMENT}")
        text = Source(path.stem, shown(path), path, None, None, ()).read()[0]
        found = parse_assignment(path.stem, text, shown(path))
        add_folder(path.parent)
        there = lessons()
        for key in found.lessons:
            if key in there.broken:
                raise there.broken[key]
        for problem in amiss(found, text, there.lessons, {*there.lessons, *there.broken}):
            raise problem
        refuse_unknown_pages(found)
        if (known := there.assignments.get(found.key)) is None or known.digest != found.digest:
            raise InputError(f"{typed}: there is another assignment {found.key!r}; rename this one")
        return known

    def problems(self) -> list[str]:
        """Return a line for each mistake in the folders looked into, of lessons, courses, guides and assignments."""
        from armlab.commands._guides import mistakes_in_guide  # needs the benches, as no other command here does

        found = lessons()
        known = {*found.lessons, *found.broken}
        of_files = []
        for folder in self._looked_into.values():
            for error in (*mistakes_in(folder, known, found.needs), *_unusable_in(folder, found, known)):
                file = shown(folder.joinpath(error.file.partition(",")[0]))
                of_files.append(f"{file}:{getattr(error, 'line', 1)}: {in_words(error)}")
        of_guides = [
            f"{shown(folder.joinpath(GUIDE))}:{getattr(error, 'line', 1)}: {in_words(error)}"
            for folder in self._looked_into.values()
            for error in mistakes_in_guide(folder)
        ]
        return [*dict.fromkeys(self._problems), *of_files, *of_guides]

    def _at(self, typed: str, path: Path) -> list[Found]:
        """Return the lessons of a file or folder, and add its folder to those of the lab."""
        if path.is_dir() and not (path / LESSON).is_file():
            add_folder(path)
            found = self._in(path)
            if not found and not self._problems:
                raise InputError(f"{typed}: there is no lesson in this folder; expected NAME{ENDING} or NAME/{LESSON}")
            return found
        whole = path.parent if path.name == LESSON else path
        if path.is_file() and (not path.name.endswith(ENDING) or path.name.lower() == README):
            raise InputError(f"{typed}: expected a lesson, NAME{ENDING}")
        add_folder(whole.parent)
        found, wrong = _looked(whole.parent)
        # Beside NAME.md there may be a folder NAME: the one that was typed is meant.
        meant = [each for each in found if isinstance(each.source.text, Path) and _of(each.source.text, whole)]
        if not meant:
            refused = next((problem for name, problem in wrong if name == whole.name), "")
            raise InputError(f"{typed}: {refused or f'expected a lesson, NAME{ENDING} or NAME/{LESSON}'}")
        return meant

    def _in(self, folder: Traversable) -> list[Found]:
        found, wrong = _looked(folder)
        self._looked_into[str(folder)] = folder
        self._problems += [f"{shown(folder.joinpath(name) if name else folder)}: {problem}" for name, problem in wrong]
        return found


def add_lessons_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--lessons DIR``."""
    parser.add_argument(
        "--lessons", type=Path, action="append", default=[], metavar="DIR", help="a folder of lessons; may be repeated"
    )


def _unusable_in(folder: Traversable, found: Lessons, known: Collection[str]) -> Iterator[ContentError]:
    """Yield what is wrong with the assignments of a folder, also pages that do not exist."""
    assigned, wrong = assignments_in(folder, found.lessons, known)
    yield from wrong
    for each in assigned.values():
        try:
            refuse_unknown_pages(each)
        except ContentError as error:
            yield error


def in_words(error: ContentError) -> str:
    """Return a mistake without the name of its file."""
    return f"{error.key}: {error.problem}" if error.key else error.problem


def _of(text: Path, whole: Path) -> bool:
    return whole in (text.absolute(), text.absolute().parent)


def _looked(folder: Traversable) -> tuple[list[Found], list[tuple[str, str]]]:
    """Return the lessons of a folder, with their files as a person at the working folder can open them.

    Beside them what cannot be a lesson: its name, empty for the folder itself, and why.
    """
    label = f"{folder.name}/"
    sources, wrong = sources_of(folder, label)
    found = [Found(source.key, shown(source.text), source) for source in sources]
    problems = [(error.file.removeprefix(label), error.problem) for error in wrong]
    first: dict[str, Source] = {}
    for source in sources:
        other = first.setdefault(source.key, source)
        if other is not source:
            name, there = source.file.removeprefix(label), other.file.removeprefix(label)
            problems.append((name, f"the lesson {source.key!r} is there already, in {there}; rename one"))
    return found, problems


def shown(file: Traversable) -> str:
    """Return the name of a file: from the working folder where it is inside, else whole."""
    if not isinstance(file, Path):
        return file.name
    path = file.absolute()
    return os.path.relpath(path) if path.is_relative_to(Path.cwd()) else str(path)
