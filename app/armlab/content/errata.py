"""The errata of the course notes: what is printed, what is right and why, how bad it is, and where it belongs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import resources
from types import MappingProxyType
from typing import Any

from armlab.content.reader import Table
from armlab.content.rows import SECTION, Reference, known, unknown
from armlab.errors import ContentError
from armlab.registry import known_name

FILE = "errata.toml"

CHAPTERS = ("1", "2", "3", "4", "5", "6", "7", "A")
"""Chapters of the notes that have errata; A is the appendix."""

SEVERITIES = {"A": "wrong if copied", "B": "claims too much", "C": "misprint", "H": "history"}
"""Severities, each in words."""

ID = re.compile(r"[1-9A]\.[0-9A-Za-z]{1,8}")
"""Pattern of the ids: the number of the equation or a short name, after the chapter; letters tell several apart."""

LINK = re.compile(r'href="/erratum/(?P<id>[^"]*)"')
"""Pattern of a link to an erratum in the HTML of a lesson."""

_NUMBERS = re.compile(r"(\d)\.(\d+)(?: to (?:\d\.)?(\d+))?(?![.\d])")
_SIGNS = re.compile(r"[^\w\s.]+")


@dataclass(frozen=True, eq=False)
class Erratum:
    """One erratum.

    Attributes
    ----------
    id : str
        Such as ``5.58``.
    place : str
        Where it is in the notes, such as ``equation 1.58``.
    section : str
    severity : str
        One of `SEVERITIES`.
    title : str
        What it is about, in a few words.
    printed, correct, why : str
        Markdown with LaTeX.
    rows : tuple of str
        Rows of the inventory to which it belongs.
    unrun : str
        Why there is nothing to run; empty where there is a trial.
    task : mapping
        The table of its task, as `armlab.content.errata_task` reads it; empty where there is none.
    """

    id: str
    place: str
    section: str
    severity: str
    title: str
    printed: str
    correct: str
    why: str
    rows: tuple[str, ...]
    unrun: str
    task: Mapping[str, Any]

    @property
    def key(self) -> str:
        """The id, by which it stands in registries."""
        return self.id

    @property
    def chapter(self) -> str:
        """The number of its chapter, or A for the appendix."""
        return self.section.partition(".")[0]

    @property
    def says(self) -> str:
        """The severity in words."""
        return SEVERITIES[self.severity]

    @cached_property
    def references(self) -> tuple[Reference, ...]:
        """The equations that its place names."""
        found = _NUMBERS.findall(re.sub(r"\b(?:sections?|figures?) [\d.]+", "", self.place))
        return tuple(Reference("equation", int(c), int(first), int(last or first)) for c, first, last in found)

    @cached_property
    def words(self) -> str:
        """All of its texts in small letters, without the signs of Markdown and LaTeX."""
        every = (self.id, self.place, self.section, self.title, self.printed, self.correct, self.why, self.says)
        return _plain(" ".join(every))


def parse_errata(text: str, file: str = FILE) -> dict[str, Erratum]:
    """Read the file of the errata, by id in its order.

    Raises
    ------
    ContentError
        A missing, wrong or unknown key, an id that comes twice, a section or row that is not there.
    """
    top = Table.parse(file, text)
    found: dict[str, Erratum] = {}
    for table in top.tables("errata"):
        erratum = _erratum(table)
        if erratum.id in found:
            raise table.fail("id", f"{erratum.id!r} comes twice")
        found[erratum.id] = erratum
    top.done()
    return found


def _erratum(table: Table) -> Erratum:
    erratum = Erratum(
        id=table.text("id"),
        place=table.text("place"),
        section=table.text("section"),
        severity=table.choice("severity", SEVERITIES),
        title=table.text("title"),
        printed=table.text("printed"),
        correct=table.text("correct"),
        why=table.text("why"),
        rows=table.texts("rows"),
        unrun=table.text("unrun", ""),
        task=MappingProxyType(table.value("task", {})),
    )
    table.done()
    if not ID.fullmatch(erratum.id):
        raise table.fail("id", f"expected a chapter, a point, digits and letters, such as '5.58', got {erratum.id!r}")
    if not SECTION.fullmatch(erratum.section) or erratum.chapter not in CHAPTERS:
        raise table.fail("section", f"expected a section of the notes such as '4.3.1', got {erratum.section!r}")
    for row in erratum.rows:
        if not known(row):
            raise table.fail("rows", unknown(row))
    return erratum


@cache
def errata() -> Mapping[str, Erratum]:
    """Return the errata by id, in the order of the notes."""
    text = (resources.files("armlab.content") / FILE).read_text(encoding="utf-8")
    found = parse_errata(text)
    if not found:
        raise ContentError(FILE, "errata", "expected at least one erratum [[errata]]")
    return MappingProxyType(found)


def erratum(key: object) -> Erratum:
    """Return an erratum by its id; `UnknownName` when there is none.

    >>> erratum("1.58").says
    'wrong if copied'
    """
    return errata()[known_name("erratum", key, errata())]


def find(text: str = "", severity: str = "", chapter: str = "") -> tuple[Erratum, ...]:
    """Return the errata of a severity and a chapter on what was typed, in the order of the notes.

    Parameters
    ----------
    text : str
        Words, all of which are to be found, or the number of an equation or a section; empty for everything.
    severity, chapter : str
        Empty for all.

    Examples
    --------
    >>> [each.id for each in find("4.93")], [each.id for each in find("harmonic drive")]
    (['4.94'], ['2.29'])
    """
    asked = _plain(text).split()
    return tuple(
        each
        for each in errata().values()
        if (not severity or each.severity == severity)
        and (not chapter or each.chapter == chapter)
        and all(_holds(each, word) for word in asked)
    )


def _holds(each: Erratum, word: str) -> bool:
    number = _NUMBERS.fullmatch(word)
    if number is None:
        return word in each.words
    asked = Reference("equation", int(number[1]), int(number[2]), int(number[2]))
    of_section = f"{each.section}.".startswith(f"{word}.")
    return of_section or each.id == word or any(own.meets(asked) for own in each.references)


def _plain(text: str) -> str:
    return " ".join(_SIGNS.sub(" ", text.replace("″", "").replace("′", "")).casefold().split())


def linked(html: str) -> tuple[str, ...]:
    """Return the ids of the errata to which a text of a lesson leads, without repetitions.

    >>> linked('<a href="/erratum/1.58">1.58</a>')
    ('1.58',)
    """
    return tuple(dict.fromkeys(found["id"] for found in LINK.finditer(html)))
