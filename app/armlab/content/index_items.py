"""Entries of the index of the lab: topics of the notes, lessons, pages and whatever else can be looked for."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from armlab import kin
from armlab.content.citations import functions
from armlab.content.lesson_head import time_said
from armlab.content.rows import SECTION, Reference, Row, chapters, reference, rows

Kind = Literal["chapter", "row", "lesson", "bench", "function", "arm", "command", "setting", "export"]

BELONGS: tuple[Kind, ...] = ("lesson", "bench", "function")
"""Kinds of entries that belong to topics of the notes."""


@dataclass(frozen=True)
class Thing:
    """Something of the lab that can be found: a page, an arm, a command, a setting, a file to save.

    Attributes
    ----------
    kind : str
        One of `Kind`.
    key, title : str
    about : tuple of str
        Sections with all that is in them (``"4.1"``), rows (``"S4.1-dh"``), equations (``"(5.139-5.152)"``), words.
    within : str
        Title of what it is a part of, such as the tab of a page.
    names : tuple of str
        Other titles.
    detail : str
        A line about it; the words of ``about`` when left out.
    """

    kind: Kind
    key: str
    title: str
    about: tuple[str, ...] = ()
    within: str = ""
    names: tuple[str, ...] = ()
    detail: str = ""


@dataclass(frozen=True)
class Entry:
    """A result of the index.

    Attributes
    ----------
    kind : str
        One of `Kind`.
    key : str
        Number of the chapter, id of the row, dotted name of the function, key of anything else.
    title, detail : str
    within : str
        Title of what it is a part of; empty for none.
    rows : tuple of str
        Ids of the rows it belongs to; of a row its own.
    lessons, benches, functions : tuple of str
        Only of rows: keys of what belongs to them.
    absent : str
        Only of rows: a sentence where the lab has nothing about it; empty otherwise.
    """

    kind: Kind
    key: str
    title: str
    detail: str
    rows: tuple[str, ...] = ()
    lessons: tuple[str, ...] = ()
    benches: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    within: str = ""
    absent: str = ""


class Taught(NamedTuple):
    """The data of a lesson for the index: the chapter is that of its course, ``can`` the words by which it is found."""

    key: str
    title: str
    chapter: str
    teaches: tuple[str, ...]
    can: tuple[str, ...] = ()
    minutes: int = 0


@dataclass(frozen=True)
class Item:
    """An entry together with the words and numbers by which it is found.

    Attributes
    ----------
    entry : Entry
    names, words : tuple of str
        Other titles, and other words.
    references : tuple of Reference
    sections : tuple of str
    """

    entry: Entry
    names: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    references: tuple[Reference, ...] = ()
    sections: tuple[str, ...] = ()


def items_of(taught: Iterable[Taught], things: Iterable[Thing]) -> tuple[Item, ...]:
    """Return all items: chapters, rows, lessons, things, functions."""
    others = [*map(_lesson_item, taught), *map(_thing_item, things), *_function_items()]
    of_row: defaultdict[str, list[Item]] = defaultdict(list)
    for item in others:
        for row in item.entry.rows:
            of_row[row].append(item)
    own = [_row_item(row, of_row[row.id]) for row in rows().values()]
    return (*(_chapter_item(key, own) for key in chapters()), *own, *others)


def _chapter_item(key: str, own: Iterable[Item]) -> Item:
    """Return a chapter with the numbers of what it contains."""
    entries = [item.entry for item in own if rows()[item.entry.key].chapter == key]
    counts = [_count(len(entries), "topic", "topics")]
    for kind, one, many in (("lessons", "lesson", "lessons"), ("functions", "function", "functions")):
        number = len({name for entry in entries for name in getattr(entry, kind)})
        counts += [_count(number, one, many)] if number else []
    entry = Entry("chapter", key, chapters()[key], ", ".join(counts), tuple(entry.key for entry in entries))
    return Item(entry, sections=(key,))


def _count(number: int, one: str, many: str) -> str:
    return f"{number} {one if number == 1 else many}"


def _row_item(row: Row, belonging: Iterable[Item]) -> Item:
    of = {kind: tuple(item.entry.key for item in belonging if item.entry.kind == kind) for kind in BELONGS}
    title = chapters()[row.section] if row.section in ("A", "R") else f"Section {row.section}"
    equations = "equation" if len(row.equations) == 1 and "-" not in row.equations[0] else "equations"
    cited = ([f"{equations} {', '.join(row.equations)}"] if row.equations else []) + list(row.numbered)
    detail = "; ".join([title, *cited])
    belong = of["lesson"], of["bench"], of["function"]
    entry = Entry("row", row.id, row.title, detail, (row.id,), *belong, absent=row.absent)
    return Item(entry, words=row.words, references=row.references, sections=(row.section,))


def _lesson_item(lesson: Taught) -> Item:
    detail = ", ".join(filter(None, (lesson.chapter, time_said(lesson.minutes))))
    return Item(Entry("lesson", lesson.key, lesson.title, detail, lesson.teaches), words=lesson.can)


def _thing_item(thing: Thing) -> Item:
    """Return a thing; it is found by its titles, sections, rows, equations in brackets, or words.

    It belongs only to the rows that it names: a section says where it is found, and not that all of it is there.
    """
    sections = tuple(about for about in thing.about if SECTION.fullmatch(about))
    cited = [reference("equation", about[1:-1]) for about in thing.about if about.startswith("(")]
    references = tuple(one for one in cited if one is not None)
    words = tuple(
        about for about in thing.about if about not in sections and about not in rows() and not about.startswith("(")
    )
    belongs = tuple(row for row in rows() if row in thing.about)
    entry = Entry(thing.kind, thing.key, thing.title, thing.detail or ", ".join(words), belongs, within=thing.within)
    return Item(entry, thing.names, words, references, sections)


def _function_items() -> Iterator[Item]:
    """Yield functions; each belongs to the rows whose numbers it cites, and to those that name it."""
    for one in functions():
        belongs = tuple(
            row.id for row in rows().values() if one.name in row.core or any(map(row.cites, one.cites.references))
        )
        title = one.name.removeprefix(f"{kin.__name__}.").rpartition(".")[2]
        entry = Entry("function", one.name, title, one.says, belongs)
        yield Item(entry, references=one.cites.references, sections=one.cites.sections)
