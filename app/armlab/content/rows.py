"""The inventory of the course notes: rows that a lesson can teach, and the numbers by which they are cited."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache, cached_property
from importlib import resources
from types import MappingProxyType
from typing import NamedTuple

from armlab.content.reader import Table
from armlab.errors import ContentError

FILE = "rows.toml"
KINDS = ("equation", "figure", "definition", "theorem")
"""Kinds of items that are numbered in the notes."""

ID = re.compile(r"S(?:\d+(?:\.\d+)*|A|R)-[A-Za-z0-9-]+")
SECTION = re.compile(r"\d+(?:\.\d+){0,2}|A|R")
_NUMBER = re.compile(r"(?:(\d+)\.)?(\d+)(?:[-\u2013](?:(\d+)\.)?(\d+))?")


class Reference(NamedTuple):
    """One number of the notes or a range of them: equations 4.85 to 4.88 are ``("equation", 4, 85, 88)``.

    Definitions and theorems are counted through all chapters; theirs is 0.
    """

    kind: str
    chapter: int
    first: int
    last: int

    def meets(self, other: Reference) -> bool:
        """Return whether both have a number in common."""
        return self[:2] == other[:2] and self.first <= other.last and other.first <= self.last


def reference(kind: str, text: str) -> Reference | None:
    """Return what a text such as ``3.66`` or ``4.85-4.88`` refers to, or None when it is nothing of that kind.

    >>> reference("equation", "4.85-4.88")
    Reference(kind='equation', chapter=4, first=85, last=88)
    """
    found = _NUMBER.fullmatch(text)
    if found is None:
        return None
    chapter, first, last_chapter, last = found.groups()
    in_chapters = kind in ("equation", "figure")
    if (chapter is not None) != in_chapters or (last is not None and last_chapter != chapter):
        return None
    low = int(first)
    high = int(last) if last else low
    return Reference(kind, int(chapter or 0), low, high) if low <= high else None


@dataclass(frozen=True)
class Row:
    """One topic of the notes.

    Attributes
    ----------
    id : str
        Such as ``S4.1-dh``.
    section : str
        Such as ``4.1``; ``4`` alone is the text before section 4.1, ``A`` the appendix, ``R`` the robots.
    title : str
    equations : tuple of str
        Numbers of the notes, such as ``3.66`` or ``4.85-4.88``.
    numbered : tuple of str
        Figures, definitions and theorems, such as ``figure 4.8``.
    words : tuple of str
        Other names of the topic.
    core : tuple of str
        Dotted names of what computes it in `armlab.kin`, where nothing there cites its numbers.
    absent : str
        A sentence where the lab has nothing about it; empty otherwise.
    """

    id: str
    section: str
    title: str
    equations: tuple[str, ...]
    numbered: tuple[str, ...]
    words: tuple[str, ...]
    core: tuple[str, ...] = ()
    absent: str = ""

    @property
    def chapter(self) -> str:
        """The chapter: ``1`` to ``7``, ``A`` or ``R``."""
        return self.section.partition(".")[0]

    @cached_property
    def references(self) -> tuple[Reference, ...]:
        """Its equations, then its other numbered items."""
        given = [("equation", number) for number in self.equations]
        given += [(kind, number) for kind, _, number in (entry.partition(" ") for entry in self.numbered)]
        found = (reference(kind, number) for kind, number in given)
        return tuple(one for one in found if one is not None)

    def cites(self, other: Reference) -> bool:
        """Return whether one of its numbers is among those of the other."""
        return any(own.meets(other) for own in self.references)


def parse_rows(text: str, file: str = FILE) -> tuple[dict[str, str], dict[str, Row]]:
    """Read the file of the inventory.

    Returns
    -------
    chapters : dict
        Number or letter to title.
    rows : dict
        Id to row, in the order of the notes.

    Raises
    ------
    ContentError
        A missing, wrong or unknown key, a row that comes twice, a section of no chapter, a number that is none.
    """
    top = Table.parse(file, text)
    heads = top.table("chapters")
    if heads is None:
        raise top.fail("chapters", "expected a table [chapters] of titles")
    chapters = {key: heads.text(key) for key in _chapters(heads)}
    heads.done()
    rows: dict[str, Row] = {}
    for table in top.tables("rows"):
        row = _row(table, chapters)
        if row.id in rows:
            raise table.fail("id", f"{row.id!r} comes twice")
        rows[row.id] = row
    top.done()
    return chapters, rows


def _chapters(heads: Table) -> Iterable[str]:
    return (key for key in ("1", "2", "3", "4", "5", "6", "7", "A", "R") if heads.has(key))


def _row(table: Table, chapters: Mapping[str, str]) -> Row:
    row = Row(
        id=table.text("id"),
        section=table.text("section"),
        title=table.text("title"),
        equations=table.texts("equations"),
        numbered=table.texts("numbered"),
        words=table.texts("words"),
        core=table.texts("core"),
        absent=table.text("absent", ""),
    )
    table.done()
    if not ID.fullmatch(row.id):
        raise table.fail("id", f"expected an id such as 'S4.1-dh', got {row.id!r}")
    if not SECTION.fullmatch(row.section) or row.chapter not in chapters:
        raise table.fail("section", f"expected a section of chapters {', '.join(chapters)}, got {row.section!r}")
    if any(reference("equation", number) is None for number in row.equations):
        raise table.fail("equations", f"expected numbers such as '3.66' or '4.85-4.88', got {row.equations}")
    for entry in row.numbered:
        kind, _, number = entry.partition(" ")
        if kind not in KINDS[1:] or reference(kind, number) is None:
            raise table.fail("numbered", f"expected such as 'figure 4.8' or 'theorem 2', got {entry!r}")
    return row


@cache
def _inventory() -> tuple[Mapping[str, str], Mapping[str, Row]]:
    text = (resources.files("armlab.content") / FILE).read_text(encoding="utf-8")
    chapters, found = parse_rows(text)
    if not found:
        raise ContentError(FILE, "rows", "expected at least one row [[rows]]")
    return MappingProxyType(chapters), MappingProxyType(found)


def rows() -> Mapping[str, Row]:
    """Return the inventory by id, in the order of the notes."""
    return _inventory()[1]


def chapters() -> Mapping[str, str]:
    """Return the titles of the chapters by number or letter."""
    return _inventory()[0]


def known(row: str) -> bool:
    """Return whether there is a row of this id.

    >>> known("S4.1-dh"), known("S4.1-hd")
    (True, False)
    """
    return row in rows()


def suggest(row: str, most: int = 3) -> tuple[str, ...]:
    """Return ids that may have been meant by one that does not exist: similar ones, else those of its section.

    >>> suggest("S4.1-hd")[0]
    'S4.1-dh'
    """
    by_case = {known_id.casefold(): known_id for known_id in rows()}
    close = [by_case[name] for name in get_close_matches(row.casefold(), by_case, n=most)]
    place = re.match(r"S?(\d+(?:\.\d+)*|A|R)(?![A-Za-z0-9])", row.strip(), re.IGNORECASE)
    section = place[1].upper() if place else ""
    same = [one.id for one in rows().values() if section and one.section == section and one.id not in close]
    return tuple([*close, *same][:most])


def unknown(row: str) -> str:
    """Return the words for a row that does not exist, to stand in a message: what came and what may have been meant.

    >>> unknown("S9.9-nothing-at-all")
    "unknown row of the inventory 'S9.9-nothing-at-all'; the index of the lab finds rows by word and equation"
    """
    near = suggest(row)
    hint = f"did you mean {', '.join(map(repr, near))}?" if near else ""
    return f"unknown row of the inventory {row!r}; {hint or 'the index of the lab finds rows by word and equation'}"
