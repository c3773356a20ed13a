"""Tables of lessons, which also contain lists of words, truth values and whole numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any, Self

from armlab.content.reader import Table, shown
from armlab.errors import suggestion

_EXAMPLE = re.compile(r"[a-z0-9_]+/[a-z0-9_]+")


class Fields(Table):
    """A table with further kinds of values."""

    @classmethod
    def of(cls, table: Table) -> Self:
        """Return an unread copy of the table; `done` need not be called on the original."""
        return cls(table.file, table._data, table.where)

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys of the table, in the order of the file."""
        return tuple(self._data)

    @property
    def data(self) -> dict[str, Any]:
        """The parsed table."""
        return self._data

    def whole(self, key: str, least: int, most: int) -> int:
        """Take a whole number, which may be written 2 or 2.0."""
        return self._whole(key, self.number(key), least, most)

    def words(self, key: str, *, required: bool = False) -> tuple[str, ...]:
        """Take a list of texts."""
        value = self._take(key, None if required else [])
        if not isinstance(value, list) or not all(isinstance(word, str) and word for word in value):
            raise self.fail(key, f"expected a list of texts, got {shown(value)}")
        return tuple(value)

    def some_of(self, key: str, options: Iterable[str]) -> tuple[str, ...]:
        """Take a list of words out of some."""
        names, words = list(options), self.words(key)
        for i, word in enumerate(words):
            if word not in names:
                raise self.fail(f"{key}[{i + 1}]", f"unknown value {word!r}{suggestion(word, names)}")
        return words

    def wholes(self, key: str, least: int, most: int) -> tuple[int, ...]:
        """Take a list of whole numbers."""
        value = self._take(key, [])
        if not isinstance(value, list):
            raise self.fail(key, f"expected a list of whole numbers, got {shown(value)}")
        return tuple(
            self._whole(f"{key}[{i + 1}]", self._number(f"{key}[{i + 1}]", entry), least, most)
            for i, entry in enumerate(value)
        )

    def _whole(self, key: str, value: float, least: int, most: int) -> int:
        if value != int(value) or not least <= value <= most:
            raise self.fail(key, f"expected a whole number from {least} to {most}, got {value:g}")
        return int(value)


def example_name(table: Table, key: str) -> str:
    """Take the name of an example of a bench, ``"motion/corner_fly"``; only the lab knows which exist."""
    name = table.text(key)
    if not _EXAMPLE.fullmatch(name):
        raise table.fail(key, f"expected BENCH/NAME such as 'motion/corner_fly', got {shown(name)}")
    return name
