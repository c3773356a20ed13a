"""The teacher's desk: who has its key puts lessons, assignments and the course for everybody into one folder."""

from __future__ import annotations

import base64
import hmac
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from armlab.content.assignment import amiss, parse_assignment
from armlab.content.course import misplaced, parse_course
from armlab.content.guesses import Guesses
from armlab.content.held import hold_lesson
from armlab.content.lesson_folder import COURSE, ENDING, LESSON, MOST_LESSONS, OF_ASSIGNMENT
from armlab.content.lessons import lessons
from armlab.content.upload import ASSIGNMENT, COURSE_KIND, LESSON_KIND, Upload
from armlab.errors import InputError

SHORTEST_KEY, LONGEST_KEY = 8, 100
BEFORE = ".before-"
"""Beginning of the name under which the file that was there is kept; hidden files are no lessons."""

LOADING = ".loading-"


A = {LESSON_KIND: "a lesson", ASSIGNMENT: "an assignment"}
"""Names of what may be there already."""


class Desk:
    """A folder of lessons that is written into from the browser.

    Parameters
    ----------
    folder : Path
    key : str
    clock : callable
    """

    def __init__(self, folder: Path, key: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder, self._key, self._guesses = folder.resolve(), key.encode(), Guesses(clock)

    def let_in(self, said: str, browser: str, address: str) -> None:
        """Raise `InputError` unless this is the key; who guesses has to wait, and nobody else.

        Parameters
        ----------
        said : str
        browser, address : str
            Token of the browser that says it, and where it comes from.
        """
        if self._guesses.must_wait(browser, address):
            raise InputError("Too many wrong keys were tried. Wait a little.")
        if not hmac.compare_digest(said.strip()[:LONGEST_KEY].encode("utf-8", "replace"), self._key):
            self._guesses.note(browser, address)
            raise InputError("This is not the key of the teacher.")

    def put(self, upload: Upload, loaded: Mapping[str, str] = MappingProxyType({})) -> str:
        """Put a file into the folder; return its name there. The one that was there is kept as a hidden file.

        Parameters
        ----------
        upload : Upload
        loaded : mapping of str to str
            Files of the lessons that whoever puts it there has loaded, by their names in a course or an assignment.

        Raises
        ------
        ContentError
            It cannot be used: nothing changes.
        InputError
            Something elsewhere has its name, a lesson that it names is not there for everybody, the folder is full, or
            it cannot be written.
        """
        _refuse_unusable(upload, loaded)
        if len(list(self._folder.iterdir())) >= 2 * MOST_LESSONS:
            raise InputError(f"{upload.file}: the folder of the lessons is full")
        name = COURSE if upload.kind == COURSE_KIND else upload.file.partition("/")[0]
        self._refuse_elsewhere(upload)
        try:
            if upload.pictures is None:
                self._write(name, upload.text)
            else:
                self._write_folder(name, upload)
            if upload.kind == LESSON_KIND:  # of NAME.md and NAME the other one goes
                self._set_aside(upload.name if name.endswith(ENDING) else f"{upload.name}{ENDING}")
        except OSError as error:
            raise InputError(f"{upload.file}: cannot be written: {error.strerror}") from None
        return name

    def _refuse_elsewhere(self, upload: Upload) -> None:
        name, there = upload.name, lessons()
        if upload.kind == LESSON_KIND:
            here = (self._folder / f"{name}{ENDING}").exists() or (self._folder / name / LESSON).exists()
            is_taken = name in there.lessons
        else:
            here = (self._folder / f"{name}{OF_ASSIGNMENT}").exists()
            is_taken = upload.kind == ASSIGNMENT and there.has_assignment(name)
        if is_taken and not here:
            raise InputError(f"{upload.file}: the lab has {A[upload.kind]} {name!r} already; rename this one")

    def _write(self, name: str, text: str) -> None:
        handle, made = tempfile.mkstemp(dir=self._folder, prefix=LOADING)
        try:
            with os.fdopen(handle, "w", encoding="utf-8", newline="") as file:
                file.write(text)
            os.chmod(made, 0o644)
            self._keep_copy(name)
            os.replace(made, self._folder / name)
        except BaseException:
            Path(made).unlink(missing_ok=True)
            raise

    def _write_folder(self, name: str, upload: Upload) -> None:
        made = Path(tempfile.mkdtemp(dir=self._folder, prefix=LOADING))
        try:
            (made / LESSON).write_text(upload.text, encoding="utf-8", newline="")
            for picture, address in (upload.pictures or {}).items():
                (made / picture).write_bytes(base64.b64decode(address.partition(",")[2]))
            made.chmod(0o755)
            self._set_aside(name)
            made.rename(self._folder / name)
        except BaseException:
            shutil.rmtree(made, ignore_errors=True)
            raise

    def _keep_copy(self, name: str) -> None:
        """Keep a copy of a file that is about to be replaced, which is there at every moment."""
        there, kept = self._folder / name, self._folder / f"{BEFORE}{name}"
        if there.is_file() and not there.is_symlink():
            kept.unlink(missing_ok=True)
            shutil.copyfile(there, kept)

    def _set_aside(self, name: str) -> None:
        """Keep what is there under a hidden name, in place of what was kept before."""
        there, kept = self._folder / name, self._folder / f"{BEFORE}{name}"
        if not there.exists() and not there.is_symlink():
            return
        if kept.is_dir() and not kept.is_symlink():
            shutil.rmtree(kept)
        there.replace(kept)


def _refuse_unusable(upload: Upload, loaded: Mapping[str, str]) -> None:
    """Raise `ContentError` or `InputError` where a file cannot be used with what is there for everybody."""
    there = lessons()
    known = {*there.lessons, *there.broken}
    if upload.kind == LESSON_KIND:
        hold_lesson(upload)
    elif upload.kind == ASSIGNMENT:
        found = parse_assignment(upload.name, upload.text, upload.file)
        _refuse_ones_own(upload, found.lessons, loaded, known)
        for problem in amiss(found, upload.text, there.lessons, known):
            raise problem
    elif upload.kind == COURSE_KIND:
        course = parse_course("", upload.text, upload.file)
        _refuse_ones_own(upload, course.lessons, loaded, known)
        for error in misplaced(course, upload.text, upload.file, known, there.needs):
            raise error
    else:
        raise InputError(f"{upload.name}{OF_ASSIGNMENT}: an arm is not put into a folder of lessons")


def _refuse_ones_own(
    upload: Upload, lessons_named: Iterable[str], loaded: Mapping[str, str], known: Collection[str]
) -> None:
    """Raise `InputError` where a course or an assignment names lessons that nobody else sees yet."""
    own = dict.fromkeys(loaded[key] for key in lessons_named if key in loaded and key not in known)
    if own:
        them = "it" if len(own) == 1 else "them"
        raise InputError(f"{upload.file}: only you see {', '.join(own)} so far; put {them} there for everybody first")


_desks: list[Desk] = []


def desk() -> Desk | None:
    """Return the desk of this process; None where nobody may write for everybody."""
    return _desks[-1] if _desks else None


def open_desk(found: Desk) -> Callable[[], None]:
    """Let a desk be that of this process; returns what closes it again."""
    _desks.append(found)
    return lambda: _desks.remove(found)
