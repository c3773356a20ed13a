"""The formulas of the course in their correct forms, by the chapters of its notes, for two sheets of paper."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType

from armlab.content.errata import errata
from armlab.content.reader import Table
from armlab.content.rows import chapters
from armlab.registry import known_name

FILE = "formulas.toml"


@dataclass(frozen=True)
class Formula:
    """One or several formulas under a name.

    Attributes
    ----------
    name, note : str
        Plain text with formulas between dollars; ``note`` is empty for none.
    tex : tuple of str
        LaTeX, with amsmath alone.
    errata : tuple of str
        Ids of the errata of which it is the correct form.
    key : str
        Name for the tests; empty for none.
    """

    name: str
    tex: tuple[str, ...]
    note: str = ""
    errata: tuple[str, ...] = ()
    key: str = ""


@dataclass(frozen=True)
class Sheet:
    """The formulas.

    Attributes
    ----------
    about : str
        How they are written, as `Formula.name`.
    pages : tuple of mapping of str to tuple of Formula
        The formulas of each page by title of the chapter.
    """

    about: str
    pages: tuple[MappingProxyType[str, tuple[Formula, ...]], ...]

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """All of them."""
        return tuple(each for page in self.pages for formulas in page.values() for each in formulas)


def parse_formulas(text: str, file: str = FILE) -> Sheet:
    """Read the file of the formulas.

    Raises
    ------
    ContentError
        A missing, wrong or unknown key, or a chapter that is not there.
    UnknownName
        An erratum that is not there.
    """
    top = Table.parse(file, text)
    about, second, tables = top.text("about"), top.choice("second", chapters()), top.tables("parts")
    top.done()
    pages: list[dict[str, tuple[Formula, ...]]] = [{}]
    for table in tables:
        chapter = table.choice("chapter", chapters())
        if chapter == second:
            pages.append({})
        pages[-1][chapters()[chapter]] = tuple(_formula(each) for each in table.tables("formulas"))
        table.done()
    return Sheet(about, tuple(map(MappingProxyType, pages)))


def _formula(table: Table) -> Formula:
    formula = Formula(
        name=table.text("name"),
        tex=table.texts("tex"),
        note=table.text("note", ""),
        errata=table.texts("errata"),
        key=table.text("key", ""),
    )
    table.done()
    if not formula.tex:
        raise table.fail("tex", "expected at least one formula, got an empty list")
    for each in formula.errata:
        known_name("erratum", each, errata())
    return formula


@cache
def sheet() -> Sheet:
    """Return the formulas of the lab."""
    return parse_formulas((resources.files("armlab.content") / FILE).read_text(encoding="utf-8"))
