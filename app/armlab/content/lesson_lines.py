"""Lines of mistakes in lesson files."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from armlab.errors import ContentError, InputError

_HEADER = re.compile(r"\s*(\[\[?)([^\[\]]+)\]\]?\s*(?:#.*)?\Z")
_KEY = re.compile(r"\s*([\w.\-\"' ]+?)\s*=")
_LAST = re.compile(r"(\[\d+\]|\.[^.\[\]]*|^[^.\[\]]+)\Z")
_TOLD = re.compile(r"at line (\d+)")


class LessonError(ContentError):
    """A lesson file is wrong at a line.

    Parameters
    ----------
    file, key, problem : str
        The parts of a `ContentError`.
    line : int
        Line, from 1.
    """

    def __init__(self, file: str, key: str, problem: str, line: int) -> None:
        super().__init__(f"{file}, line {line}", key, problem)
        self.file, self.line = file, line


@contextmanager
def located(file: str, where: str, toml: str, otherwise: int) -> Iterator[None]:
    """Add to every mistake in a table of a file its line.

    Parameters
    ----------
    file, where : str
        ``where`` is what the keys of the table begin with, such as ``step 2.check``.
    toml : str
        The text of the table, with as many empty lines before it as there are lines in the file.
    otherwise : int
        The line for what has no key of its own.
    """
    try:
        yield
    except LessonError:
        raise
    except ContentError as error:
        inside = error.key.removeprefix(where).lstrip(".")
        told = _TOLD.search(error.problem) if error.problem.startswith("not valid TOML") else None
        line = int(told[1]) if told else line_of(toml, inside)
        key = error.key or where
        raise LessonError(file, key, error.problem, line or otherwise) from None
    except InputError as error:
        raise LessonError(file, where, str(error), otherwise) from None


def line_of(toml: str, path: str) -> int:
    """Return the line, from 1, of a key such as ``wrong[2].answer``, or of the nearest enclosing table; 0 for none."""
    lines = key_lines(toml)
    while path:
        if path in lines:
            return lines[path]
        path = _LAST.sub("", path)
    return 0


def key_lines(toml: str) -> dict[str, int]:
    """Return the lines of all keys and headers of a TOML text; keys of inline tables are not looked for.

    >>> key_lines('a = 1\\n[[b]]\\nc = 2\\n[[b]]\\nc = 3')
    {'a': 1, 'b': 2, 'b[1]': 2, 'b[1].c': 3, 'b[2]': 4, 'b[2].c': 5}
    """
    lines: dict[str, int] = {}
    counts: Counter[str] = Counter()
    prefix = quotes = ""
    for number, line in enumerate(toml.split("\n"), start=1):
        if not quotes:
            header, key = _HEADER.match(line), _KEY.match(line)
            if header:
                prefix = _entered(_bare(header[2]), len(header[1]) == 2, counts, lines, number)
            elif key:
                lines.setdefault(f"{prefix}.{_bare(key[1])}" if prefix else _bare(key[1]), number)
        quotes = _still_open(line, quotes)
    return lines


def _entered(name: str, of_array: bool, counts: Counter[str], lines: dict[str, int], number: int) -> str:
    """Return the path of the table that a header begins, and record its lines."""
    path = ""
    parts = name.split(".")
    for i, part in enumerate(parts):
        path = f"{path}.{part}" if path else part
        lines.setdefault(path, number)
        counts[path] += of_array and i == len(parts) - 1
        if counts[path]:
            path = f"{path}[{counts[path]}]"
            lines.setdefault(path, number)
    return path


def _bare(name: str) -> str:
    return ".".join(part.strip().strip("\"'") for part in name.split("."))


def _still_open(line: str, quotes: str) -> str:
    """Return the quotes of a multi-line text that is open at the end of a line; empty when none is."""
    for mark in ('"""', "'''"):
        if quotes in ("", mark) and line.count(mark) % 2:
            return "" if quotes else mark
    return quotes
