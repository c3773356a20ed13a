"""Words of benches in lesson files, such as ``velocity.statics.set_component``; only the lab knows their meaning.

A word is the folder of a tab, that of a page and a name: of a command, with its arguments, or of a fact.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from armlab.content.lesson_fields import Fields
from armlab.content.lesson_lines import LessonError, line_of
from armlab.content.reader import Table, shown

_WORD = re.compile(r"[a-z][a-z0-9_]*(\.[a-z][a-z0-9_]*){2}")

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class BenchWord:
    """A command of a bench as a lesson file writes it.

    Attributes
    ----------
    word : str
    given : mapping of str to object
        Arguments in the file, with the values of the variant.
    file : str
        Name of the lesson's file in messages.
    block, path : str
        The block, such as ``step 2.solution``, and the place in it, such as ``do[1]``.
    text : str
        The TOML it stands in, after as many empty lines as stand before it in the file.
    """

    word: str
    given: Mapping[str, Any]
    file: str
    block: str
    path: str
    text: str = ""

    def wrong(self, key: str, problem: str) -> LessonError:
        """Return the error for one of its arguments, or for the whole command when the key is empty."""
        path = f"{self.path}.{key}" if key else self.path
        where = ".".join(filter(None, (self.block, path)))
        return LessonError(self.file, where, problem, line_of(self.text, path) or 1)


def is_word(text: str) -> bool:
    """Return whether a text has the form of a word.

    >>> is_word("velocity.statics.torques"), is_word("move")
    (True, False)
    """
    return _WORD.fullmatch(text) is not None


def read_word(entry: Fields) -> BenchWord:
    """Take the word in ``command``; all other keys beside it are its arguments."""
    given = {key: entry.value(key) for key in entry.keys if key != "command"}
    block, dot, path = entry.where.rpartition(".do[")
    path = f"do[{path}" if dot else entry.where
    return BenchWord(_word_in(entry, "command"), given, entry.file, block, path)


def placed(actions: tuple[T, ...], text: str) -> tuple[T, ...]:
    """Return actions whose words know the TOML in which they stand, so that mistakes are reported with their lines."""
    return tuple(replace(each, text=text) if isinstance(each, BenchWord) else each for each in actions)


def fact_name(table: Table, key: str) -> str:
    """Take the word of a fact."""
    return _word_in(table, key)


def _word_in(table: Table, key: str) -> str:
    word = table.text(key)
    if not is_word(word):
        raise table.fail(key, f"expected TAB.PAGE.NAME such as 'velocity.statics.{_EXAMPLES[key]}', got {shown(word)}")
    return word


_EXAMPLES = {"command": "set_component", "fact": "torques"}
