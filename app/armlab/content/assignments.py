"""The files of assignments in folders of lessons, read again when they change."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import partial
from importlib.resources.abc import Traversable

from armlab.content.as_written import as_written
from armlab.content.assignment import Assignment, amiss, parse_assignment
from armlab.content.lesson import Lesson
from armlab.content.lesson_folder import Source, assignments_of
from armlab.content.watched import Watched
from armlab.errors import ContentError


class AssignmentFiles:
    """The files of assignments of some folders.

    A file with a mistake changes nothing: the assignment stays as it was before.
    """

    def __init__(self) -> None:
        self._files: dict[str, Watched[Assignment]] = {}
        self._twice: list[ContentError] = []
        self._gone: dict[str, Assignment] = {}

    @property
    def gone(self) -> Mapping[str, Assignment]:
        """Assignments whose files were taken away: those who are in one can go on."""
        return self._gone

    def look(self, folders: Iterable[tuple[Traversable, str]]) -> bool:
        """Read the files that have changed; return whether any has.

        Parameters
        ----------
        folders : iterable of (Traversable, str)
            Folders, and the text before the names of their files in messages.
        """
        found: dict[str, Watched[Assignment]] = {}
        twice: list[ContentError] = []
        for source in (source for folder, label in folders for source in assignments_of(folder, label)):
            if source.key in found:
                there = found[source.key].source.file
                problem = f"the assignment {source.key!r} is there already, in {there}; rename this one"
                twice.append(ContentError(source.file, "", problem))
                continue
            found[source.key] = Watched.read(source, self._files.get(source.key), partial(_parsed, source))
        changed = list(found.items()) != list(self._files.items()) or [*map(str, twice)] != [*map(str, self._twice)]
        self._gone |= {key: file.good for key, file in self._files.items() if key not in found and file.good}
        self._files, self._twice = found, twice
        return changed

    def judged(
        self, lessons: Mapping[str, Lesson], known: Collection[str]
    ) -> tuple[dict[str, Assignment], list[ContentError]]:
        """Return the assignments by key, and what is wrong with their files.

        Parameters
        ----------
        lessons : mapping of str to Lesson
            Those that can be used.
        known : collection of str
            Keys of all lessons that have a file.
        """
        problems: list[ContentError] = [*self._twice]
        judged: dict[str, Watched[Assignment]] = {}
        for key, file in self._files.items():
            judged[key], wrong = file.judged(lambda found, text: amiss(found, text, lessons, known))
            problems += wrong
        self._files = judged
        return {key: file.good for key, file in judged.items() if file.good is not None}, problems


def _parsed(source: Source, text: str, file: str) -> Assignment:
    found = parse_assignment(source.key, text, file)
    return as_written(found, "title", "about") if source.own else found


def assignments_in(
    folder: Traversable, lessons: Mapping[str, Lesson], known: Collection[str]
) -> tuple[dict[str, Assignment], list[ContentError]]:
    """Return the assignments of a folder, and what is wrong with their files; see `AssignmentFiles.judged`."""
    files = AssignmentFiles()
    files.look([(folder, "")])
    return files.judged(lessons, known)
