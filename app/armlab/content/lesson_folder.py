"""Folders of lessons: the files, whether they have changed, and their content."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path

from armlab import resources
from armlab.content.pictures import MOST_BYTES, MOST_PICTURES, TYPES, picture
from armlab.errors import ContentError

MOST_LESSONS = 500
MOST_TEXT = 1_000_000
"""Largest size of a lesson file, bytes."""

LESSON = "lesson.md"
COURSE = "course.toml"
GUIDE = "guide.toml"
ENDING = ".md"
OF_ASSIGNMENT = ".toml"
"""Ending of an assignment; of the files with it only `COURSE` and `GUIDE` are none."""

_README = "readme.md"

Stamp = tuple[tuple[str | int, ...], ...]
"""A value that changes whenever a file of a lesson is written again."""


@dataclass(frozen=True)
class Source:
    """The files of one lesson, or that of a course, its guide or an assignment.

    Attributes
    ----------
    key : str
    file : str
        Its name in messages.
    text : Traversable
        The file of its text.
    pictures : tuple of Traversable or None
        The pictures beside it; None for a lesson that is a single file.
    root : Path or None
        The folder that must not be left; None for what lies inside an archive.
    stamp : Stamp
    """

    key: str
    file: str
    text: Traversable
    pictures: tuple[Traversable, ...] | None
    root: Path | None
    stamp: Stamp

    @property
    def own(self) -> bool:
        """Whether it lies in a teacher's folder, not in one of the lab's."""
        of_the_lab = resources.folder("lessons")
        return self.root is not None and not (
            isinstance(of_the_lab, Path) and self.root.resolve().is_relative_to(of_the_lab.resolve())
        )

    def read(self) -> tuple[str, dict[str, str] | None]:
        """Return the text, and the pictures by name as ``data:`` addresses.

        Raises
        ------
        ContentError
            A file cannot be read, is too large, leads out of the folder, or is no text or picture.
        """
        data = self._bytes(self.text, self.file, MOST_TEXT)
        try:
            text = data.decode("utf-8")
        except UnicodeDecodeError as error:
            raise ContentError(self.file, "", f"not a text in UTF-8: {error.reason}") from None
        if self.pictures is None:
            return text, None
        if len(self.pictures) > MOST_PICTURES:
            raise ContentError(self.file, "", f"expected at most {MOST_PICTURES} pictures, got {len(self.pictures)}")
        place = self.file.removesuffix(LESSON)
        found: dict[str, str] = {}
        for entry in self.pictures:
            file = f"{place}{entry.name}"
            found[entry.name] = picture(file, entry.name, self._bytes(entry, file, MOST_BYTES))
        return text, found

    def _bytes(self, entry: Traversable, file: str, most: int) -> bytes:
        try:
            if self.root is not None and isinstance(entry, Path) and not _inside(entry, self.root):
                raise ContentError(file, "", f"it leads out of the folder {self.root.name}; put the file itself there")
            with entry.open("rb") as stream:
                data = stream.read(most + 1)
        except OSError as error:
            raise ContentError(file, "", f"cannot be read: {error.strerror}") from None
        if len(data) > most:
            raise ContentError(file, "", f"expected at most {most // 1000} kB, got more")
        return data


def sources_of(folder: Traversable, label: str = "") -> tuple[list[Source], list[ContentError]]:
    """Return the lessons of a folder by name, and what is wrong with the folder itself.

    Parameters
    ----------
    folder : Traversable
    label : str
        Text before the names of files in messages, such as ``mine/``.
    """
    root = folder if isinstance(folder, Path) else None
    found: list[Source] = []
    problems: list[ContentError] = []
    try:
        entries = sorted(folder.iterdir(), key=lambda entry: entry.name) if folder.is_dir() else []
    except OSError as error:
        return [], [ContentError(label or "lessons", "", f"cannot be read: {error.strerror}")]
    for entry in entries:
        try:
            source = _source(entry, label, root)
        except ContentError as error:
            problems.append(error)
            continue
        if source is not None:
            found.append(source)
    if len(found) > MOST_LESSONS:
        problem = f"expected at most {MOST_LESSONS} lessons, got {len(found)}; those from {found[MOST_LESSONS].file} on"
        problems.append(ContentError(label or "lessons", "", f"{problem} are left out"))
    return found[:MOST_LESSONS], problems


def lesson_of(folder: Traversable, key: str) -> Source | None:
    """Return the lesson with a key in a folder, or None."""
    root = folder if isinstance(folder, Path) else None
    try:
        file, beside = folder.joinpath(f"{key}{ENDING}"), folder.joinpath(key)
        return _source(file if file.is_file() else beside, "", root)
    except OSError:
        return None


def course_of(folder: Traversable, label: str = "") -> Source | None:
    """Return the file of the course of a folder, or None; its key is that of the course, made of the folder's name."""
    return _toml_of(folder, label, COURSE)


def guide_of(folder: Traversable, label: str = "") -> Source | None:
    """Return the file of the guide of a folder, or None; its key is as of `course_of`."""
    return _toml_of(folder, label, GUIDE)


def _toml_of(folder: Traversable, label: str, name: str) -> Source | None:
    entry = folder.joinpath(name)
    try:
        if not entry.is_file():
            return None
        key = re.sub(r"[^a-z0-9]+", "_", folder.name.lower())[:40].strip("_") or "course"
        root = folder if isinstance(folder, Path) else None
        return Source(key, f"{label}{name}", entry, None, root, _stamp([entry]))
    except OSError:
        return None  # it was taken away while we looked


def assignments_of(folder: Traversable, label: str = "") -> list[Source]:
    """Return the files of assignments of a folder, by name; see `sources_of`."""
    root = folder if isinstance(folder, Path) else None
    found: list[Source] = []
    try:
        for entry in sorted(folder.iterdir(), key=lambda entry: entry.name) if folder.is_dir() else []:
            name = entry.name
            if (
                name.endswith(OF_ASSIGNMENT)
                and name not in (COURSE, GUIDE)
                and not name.startswith(".")
                and entry.is_file()
            ):
                key = name.removesuffix(OF_ASSIGNMENT)
                found.append(Source(key, f"{label}{name}", entry, None, root, _stamp([entry])))
    except OSError:
        return found  # a file was taken away while we looked
    return found


def _source(entry: Traversable, label: str, root: Path | None) -> Source | None:
    """Return the lesson at an entry of the folder, or None."""
    name = entry.name
    try:
        if name.startswith(".") or name.lower() == _README:
            return None
        if name.endswith(ENDING) and entry.is_file():
            return Source(name.removesuffix(ENDING), f"{label}{name}", entry, None, root, _stamp([entry]))
        if not entry.is_dir():
            return None
        if isinstance(entry, Path) and entry.is_symlink() and root is not None and not _inside(entry, root):
            raise ContentError(
                f"{label}{name}", "", f"it leads out of the folder {root.name}; put the files themselves there"
            )
        text = entry.joinpath(LESSON)
        if not text.is_file():
            return None
        beside = [each for each in entry.iterdir() if each.name.rpartition(".")[2].lower() in TYPES and each.is_file()]
        pictures = tuple(sorted(beside, key=lambda each: each.name))
        return Source(name, f"{label}{name}/{LESSON}", text, pictures, root, _stamp([text, *pictures]))
    except OSError:
        return None  # it was taken away while we looked


def _stamp(files: Iterable[Traversable]) -> Stamp:
    """Return names, times, sizes and inodes of files; of those in an archive, which never changes, only the names."""
    return tuple((file.name, *_of_stat(os.stat(file))) if isinstance(file, Path) else (file.name,) for file in files)


def glance(folder: Traversable) -> Stamp | None:
    """Return a value that changes whenever a file of a folder, or of a lesson that is a folder in it, changes.

    None if there is no such folder. An archive never changes.
    """
    if not isinstance(folder, Path):
        return ()
    try:
        return tuple(sorted(_glances(folder, "", deep=True)))
    except OSError:
        return None


def _glances(folder: str | Path, before: str, deep: bool) -> Iterator[tuple[str | int, ...]]:
    with os.scandir(folder) as entries:
        for entry in entries:
            yield (f"{before}{entry.name}", *_of_stat(entry.stat()))
            # A teacher's folder may hold others with thousands of files; one that gets a lesson changes itself.
            if deep and os.path.isfile(os.path.join(entry.path, LESSON)):
                yield from _glances(entry.path, f"{entry.name}/", deep=False)


def _of_stat(found: os.stat_result) -> tuple[int, ...]:
    return found.st_mtime_ns, found.st_ctime_ns, found.st_size, found.st_ino


def _inside(path: Path, root: Path) -> bool:
    return path.resolve().is_relative_to(root.resolve())
