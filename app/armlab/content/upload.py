"""Files that a teacher loads from the browser: what kind each is, its name, and the pictures of one packed as .zip.

They come from strangers: sizes are bounded before anything is unpacked, and no name in an archive is ever a path.
"""

from __future__ import annotations

import base64
import binascii
import io
import re
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from armlab.content.lesson_folder import COURSE, ENDING, GUIDE, LESSON, OF_ASSIGNMENT
from armlab.content.pictures import MOST_BYTES, MOST_PICTURES, TYPES, picture
from armlab.content.robots import KEY
from armlab.errors import ContentError, InputError

LESSON_KIND, ASSIGNMENT, COURSE_KIND, ROBOT = "lesson", "assignment", "course", "robot"

MOST_TEXT = 50_000
"""Longest text, in characters: three times the longest lesson of the lab."""

MOST_ZIP = 500_000
"""Largest archive, bytes."""

MOST_SENT = 4 * (MOST_ZIP // 3) + 400
"""Most characters of an upload: an archive in base64, with its name."""

LONGEST_NAME = 40
"""Longest name of a lesson or an assignment, in characters."""

ZIP = "zip:"
"""Beginning of the content of an archive, before its bytes in base64."""

EXPECTED = "expected a lesson (NAME.md or NAME.zip), an assignment, a course or an arm (NAME.toml)"

_COPY = re.compile(r"\s*\(\d+\)\Z")
"""Ending that browsers add to the name of a file that they save a second time."""

_TITLE = re.compile(r"""^\s*title\s*=\s*["'](.+)["']\s*$""", re.MULTILINE)
_KINDS = {
    ASSIGNMENT: re.compile(r"^\s*(\[\[\s*tasks|tasks\s*=)", re.MULTILINE),
    COURSE_KIND: re.compile(r"^\s*(\[\[\s*chapters|chapters\s*=)", re.MULTILINE),
    ROBOT: re.compile(r"^\s*(\[\[\s*joints|joints\s*=)", re.MULTILINE),
}
_UNREADABLE = (zipfile.BadZipFile, RuntimeError, NotImplementedError, EOFError, zlib.error, OSError, ValueError)
"""Errors of `zipfile` for an archive that is damaged, encrypted, or packed in a way it does not know."""


@dataclass(frozen=True)
class Upload:
    """A file as it was loaded; whether it can be used is told by its reader.

    Attributes
    ----------
    kind : "lesson", "assignment", "course" or "robot"
    name : str
        Its name without ending: that of the lesson or the assignment.
    text : str
    pictures : mapping of str to str, or None
        ``data:`` addresses by name; None for a lesson that is a single file.
    """

    kind: str
    name: str
    text: str
    pictures: Mapping[str, str] | None = None

    @property
    def file(self) -> str:
        """Name of the file of its text, for messages."""
        if self.pictures is not None:
            return f"{self.name}/{LESSON}"
        return f"{self.name}{ENDING if self.kind == LESSON_KIND else OF_ASSIGNMENT}"

    @property
    def size(self) -> int:
        """Characters that it takes."""
        return len(self.text) + sum(map(len, (self.pictures or {}).values()))


def read_upload(said: str) -> Upload:
    """Return what was loaded.

    Parameters
    ----------
    said : str
        The name of the file on a line of its own, empty for what was pasted; then its text, or `ZIP` and its bytes.

    Raises
    ------
    InputError, ContentError
        It is too large, nothing that can be loaded, or its name cannot be used.
    """
    if len(said) > MOST_SENT:
        raise InputError(f"expected a file of at most {MOST_ZIP // 1000} kB")
    given, _, content = said.partition("\n")
    file = given.replace("\\", "/").rpartition("/")[2].strip()[:100]
    if content.startswith(ZIP):
        return _unpacked(file, content.removeprefix(ZIP))
    if "\0" in content:
        raise InputError(f"{file or 'text'}: this is no text, or too long; {EXPECTED}")
    if len(content) > MOST_TEXT:
        raise InputError(f"{file or 'text'}: expected at most {MOST_TEXT} characters, got more")
    kind = _kind(file, content)
    return Upload(kind, _name(file, content, kind), content)


def _kind(file: str, text: str) -> str:
    if not text.strip():
        raise InputError(f"{file or 'text'}: {EXPECTED}, got nothing")
    if text.lstrip("\ufeff \r\n\t").startswith("+++") or file.endswith(ENDING):
        return LESSON_KIND
    found = next((kind for kind, pattern in _KINDS.items() if pattern.search(text)), None)
    if found is None:
        raise InputError(f"{file or 'text'}, line 1: {EXPECTED}, got {text.strip()[:40]!r}")
    return found


def _name(file: str, text: str, kind: str) -> str:
    """Return the name that a file has, or the one made of the title of a text that was pasted."""
    stem = _COPY.sub("", file.rpartition(".")[0] or file)
    if not file:
        title = _TITLE.search(text)
        stem = re.sub(r"[^a-z0-9]+", "_", title[1].lower()).strip("_")[:LONGEST_NAME].rstrip("_") if title else ""
        stem = stem or f"my_{kind}"
    if kind in (COURSE_KIND, ROBOT):
        return stem[:LONGEST_NAME]
    if not KEY.match(stem) or len(stem) > LONGEST_NAME:
        wanted = f"expected a file name of at most {LONGEST_NAME} lower-case letters, digits and underscores"
        raise ContentError(file, "", f"{wanted}, got {stem[:60]!r}; rename it")
    if f"{stem}{OF_ASSIGNMENT}" in (COURSE, GUIDE) or stem == "readme":
        raise ContentError(file, "", f"the name {stem!r} means something else in a folder of lessons; rename it")
    return stem


def _unpacked(file: str, packed: str) -> Upload:
    """Return the lesson of an archive: of one folder, or of files without one."""
    try:
        data = base64.b64decode(packed, validate=True)
    except (binascii.Error, ValueError):
        raise InputError(f"{file}: this is no archive in the format zip") from None
    if len(data) > MOST_ZIP:
        raise InputError(f"{file}: expected at most {MOST_ZIP // 1000} kB, got more")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return _of_archive(file, archive)
    except _UNREADABLE as error:
        if isinstance(error, InputError):
            raise
        raise InputError(
            f"{file}: this archive cannot be unpacked: {str(error)[:80] or type(error).__name__}"
        ) from None


def _of_archive(file: str, archive: zipfile.ZipFile) -> Upload:
    inside: dict[str, zipfile.ZipInfo] = {}
    folders = set()
    for entry in archive.infolist():
        # Windows PowerShell 5 writes its own separator.
        folder, _, name = entry.filename.replace("\\", "/").rpartition("/")
        if not name or name.startswith(".") or folder.startswith("__MACOSX"):
            continue
        folders.add(folder)
        inside[name] = entry
    if LESSON not in inside or len(folders) != 1:
        got = f"{len(inside)} file{'' if len(inside) == 1 else 's'}"
        raise InputError(f"{file}: expected one folder with {LESSON} and its pictures, got {got}")
    shown = {name: entry for name, entry in inside.items() if name.rpartition(".")[2].lower() in TYPES}
    if len(shown) > MOST_PICTURES:
        raise InputError(f"{file}: expected at most {MOST_PICTURES} pictures, got {len(shown)}")
    text = _bytes(archive, inside[LESSON], f"{file}: {LESSON}", 4 * MOST_TEXT)
    try:
        words = text.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ContentError(f"{file}: {LESSON}", "", f"not a text in UTF-8: {error.reason}") from None
    if len(words) > MOST_TEXT:
        raise InputError(f"{file}: {LESSON}: expected at most {MOST_TEXT} characters, got {len(words)}")
    pictures = {
        name: picture(f"{file}: {name[:60]}", name, _bytes(archive, entry, f"{file}: {name[:60]}", MOST_BYTES))
        for name, entry in sorted(shown.items())
    }
    folder = next(iter(folders)).strip("/").rpartition("/")[2]
    name = _name(f"{folder}{ENDING}" if folder else file, words, LESSON_KIND)
    return Upload(LESSON_KIND, name, words, MappingProxyType(pictures))


def _bytes(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, file: str, most: int) -> bytes:
    """Return the content of an entry, of which no more is unpacked than is taken."""
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise InputError(f"{file}: it is packed in a way that is not read here; pack the folder anew")
    with archive.open(entry) as stream:
        data = stream.read(most + 1)
    if len(data) > most:
        raise InputError(f"{file}: expected at most {most // 1000} kB, got more")
    return data
