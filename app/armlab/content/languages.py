"""The languages of the lab: English, in which it is written, and one for each catalogue in `armlab/languages`."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from armlab import resources
from armlab.content.as_written import AsWritten
from armlab.content.po import Message, read_po
from armlab.content.words import Words
from armlab.errors import UnknownName

if TYPE_CHECKING:
    from armlab.content.lesson_head import Headed

ENGLISH = "en"

CATALOGUES = files("armlab") / "languages"
"""Folder in the package, since the catalogues follow the words of its code."""

TITLE = "X-Title"
"""Field of a catalogue's header: what its language calls itself."""


@cache
def languages() -> dict[str, str]:
    """Return the languages, key to what each calls itself, English before the others."""
    return {ENGLISH: "English"} | {key: header[TITLE] for key, header in ((key, _read(key)[0]) for key in keys()[1:])}


@cache
def keys() -> tuple[str, ...]:
    """Return the keys of all languages, codes such as ``"it"``, without reading their catalogues."""
    names = sorted(file.name for file in CATALOGUES.iterdir())
    return (ENGLISH, *(name.removesuffix(".po") for name in names if name.endswith(".po")))


@cache
def messages(key: str) -> tuple[Message, ...]:
    """Return the messages of a language besides English: of its catalogue, and of the lessons that are translated.

    A lesson's translation is a file ``lessons/KEY/NAME.po``: it holds texts, so that nothing else can differ. Where
    it translates a word of the lab's own, the catalogue has the last word.
    """
    found: list[Message] = []
    for file in resources.files(f"lessons/{key}", ".po"):
        found += read_po(f"{key}/{file.name}", file.read_text(encoding="utf-8"))[1]
    return (*found, *_read(key)[1])


@cache
def translated(key: str) -> frozenset[str]:
    """Return the keys of the lessons that are translated into a language besides English."""
    return frozenset(file.name.removesuffix(".po") for file in resources.files(f"lessons/{key}", ".po"))


def only_english(lesson: Headed, key: str) -> bool:
    """Return whether a lesson is read in English by those who read the lab in another language.

    A teacher's own lessons are in the language in which they were written, which nobody has told.
    """
    return key != ENGLISH and lesson.key not in translated(key) and not isinstance(lesson.title, AsWritten)


@cache
def words_in(key: str) -> Words:
    """Return the words of a language; those of English know nothing and leave every text as it is."""
    return Words(() if key == ENGLISH else messages(key))


def preferred(accepted: str) -> str:
    """Return the language of the lab that a browser likes best.

    Parameters
    ----------
    accepted : str
        What it says of itself in the header ``Accept-Language``.

    Examples
    --------
    >>> preferred("it-IT,it;q=0.9,en;q=0.8"), preferred("fr"), preferred("en-GB,it;q=0.5")
    ('it', 'en', 'en')
    """
    return next((key for key in _in_order(accepted) if key in keys()), ENGLISH)


def _in_order(accepted: str) -> Iterable[str]:
    """Return the codes of languages in a header, the best first."""
    found: list[tuple[float, str]] = []
    for each in accepted[:200].split(","):
        name, _, weight = each.partition(";q=")
        try:
            found.append((-float(weight or 1.0), name.strip().lower().partition("-")[0]))
        except ValueError:
            continue  # a header of no browser
    return [key for _, key in sorted(found, key=lambda each: each[0])]


@cache
def _read(key: str) -> tuple[dict[str, str], list[Message]]:
    if key not in keys()[1:]:
        raise UnknownName("language", key, keys())
    file = f"{key}.po"
    return read_po(file, CATALOGUES.joinpath(file).read_text(encoding="utf-8"))
