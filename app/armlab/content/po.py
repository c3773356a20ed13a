"""Catalogues of messages in the form of gettext, ``.po``, which editors such as Poedit and Weblate write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from armlab.errors import ContentError

_LINE = re.compile(r'(?:(msgid|msgstr|msgctxt)\s+)?"((?:[^"\\]|\\.)*)"\s*\Z')
_SIGN = re.compile(r"\\(.)")
_SIGNS = {"n": "\n", "t": "\t", "r": "\r"}

WIDTH = 110
"""Largest number of characters in a line that is written, where a message has blanks."""


@dataclass(frozen=True)
class Message:
    """One message.

    Attributes
    ----------
    source, text : str
        In English, and translated; empty where it is not.
    places : tuple of str
        Where the source is found.
    fuzzy : bool
        Whether the translation has to be looked at again; it is not shown.
    line : int
        Of the file, from 1.
    """

    source: str
    text: str = ""
    places: tuple[str, ...] = ()
    fuzzy: bool = False
    line: int = 0


def read_po(file: str, text: str) -> tuple[dict[str, str], list[Message]]:
    """Return the header of a catalogue, name to value, and its messages.

    Parameters
    ----------
    file : str
        Its name in errors.
    text : str

    Raises
    ------
    ContentError
        A line is none of a catalogue, or a source comes twice.
    """
    messages = list(_messages(file, text))
    seen: dict[str, Message] = {}
    for message in messages:
        if message.source in seen:
            first = seen[message.source].line
            raise ContentError(file, "", f"line {message.line}: the message of line {first} comes again")
        seen[message.source] = message
    header = seen.pop("").text if "" in seen else ""
    pairs = (line.partition(":")[::2] for line in header.splitlines())
    return {name.strip(): value.strip() for name, value in pairs}, list(seen.values())


def write_po(header: dict[str, str], messages: Iterable[Message]) -> str:
    """Return the text of a catalogue, which `read_po` reads."""
    top = "".join(f"{name}: {value}\n" for name, value in header.items())
    return "\n".join(_written(message) for message in (Message("", top), *messages))


def _messages(file: str, text: str) -> Iterator[Message]:
    """Yield the messages of a catalogue in their order, that of the header with an empty source."""
    found: dict[str, str] = {}
    places: list[str] = []
    fuzzy, begun, word = False, 0, ""
    for number, line in enumerate((*text.split("\n"), ""), start=1):
        line = line.strip()
        if not line or (line.startswith("#") and "msgstr" in found):
            if "msgstr" in found:
                yield Message(found.get("msgid", ""), found["msgstr"], tuple(places), fuzzy, begun)
            if not line or "msgstr" in found:
                found, places, fuzzy, word = {}, [], False, ""
        if line.startswith("#:"):
            places += line[2:].split()
        elif line.startswith("#,"):
            fuzzy = "fuzzy" in line
        if not line or line.startswith("#"):
            continue
        match = _LINE.match(line)
        if match is None or not (match[1] or word):
            problem = f'line {number}: expected msgid, msgstr or a text between ", got {line[:40]!r}'
            raise ContentError(file, "", problem)
        if match[1]:
            word = match[1]
            begun = number if word == "msgid" else begun
        found[word] = found.get(word, "") + _SIGN.sub(lambda sign: _SIGNS.get(sign[1], sign[1]), match[2])


def _written(message: Message) -> str:
    lines = [f"#: {' '.join(message.places)}\n"] if message.places else []
    lines += ["#, fuzzy\n"] if message.fuzzy else []
    return "".join([*lines, _said("msgid", message.source), _said("msgstr", message.text)])


def _said(word: str, text: str) -> str:
    """Return a word and its text, on several lines where it is long or has several."""
    pieces = [piece for line in text.splitlines(keepends=True) for piece in _pieces(line)]
    if len(pieces) <= 1:
        return f'{word} "{_quoted(text)}"\n'
    return "".join([f'{word} ""\n', *(f'"{_quoted(piece)}"\n' for piece in pieces)])


def _pieces(line: str) -> Iterator[str]:
    """Yield a line in pieces that end behind blanks."""
    while len(line) > WIDTH and (end := line.rfind(" ", 0, WIDTH) + 1):
        yield line[:end]
        line = line[end:]
    yield line


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t").replace("\r", "\\r")
