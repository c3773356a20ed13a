"""Queries to the index: numbers of the notes and words in any notation, also with one slip, and in any language.

English is understood in all of them.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from functools import cache
from typing import NamedTuple

from armlab.content.languages import ENGLISH, words_in
from armlab.content.rows import KINDS, Reference, chapters, reference

SKIPPED = "a an and as at by do for from how i in is it its my of on or the to what with"
"""Words without meaning for a query; those of another language are the translation of this text."""

NUMBERED = ("chapter", "section", "equation", "formula", "figure", "definition", "theorem")
"""Words that stand before a number of the notes."""

_GREEK = {
    letter: f" {unicodedata.name(letter).rpartition(' ')[2].lower().replace('lamda', 'lambda')} "
    for letter in "αβγδεζηθκλμνξπρστφχψω"
}
_SIGNS = str.maketrans({**_GREEK, **dict.fromkeys("‐‑‒–—−", "-"), "’": "'", "×": " x "})
_WORD = r"[^\W_]+(?:['-][^\W_]+)*"
_POSSESSIVE = re.compile("'s?(?=-|$)")
_ARTICLE = re.compile(r"\b(?:[dl]|un|\w*ll)'(?=[aeiouh])")
"""An article or preposition that is joined to its word, as in dell'organo."""

_BEFORE_NUMBER = re.compile(r"[^\W\d_]+(?=[.,]?\s*\(?\d)")
_TERM = re.compile(
    r"(?P<id>\bs(?:\d+(?:\.\d+)*|a|r)-[a-z0-9-]*|\bs\d+\.\d+(?:\.\d+)?(?![\w.]))"
    r"|(?:\b(?P<kind>sec|section|chap|chapter|ch|eq|eqn|equation|formula|fig|figure|def|definition|th|thm|theorem)s?\b"
    r"[.,]?\s*|(?P<mark>§)\s*)?(?P<open>\()?"
    r"(?P<number>\b\d+(?:\.\d+){0,2}(?:\s?-\s?\d+(?:\.\d+)?)?)(?![\w-]|\.\d)\)?"
    rf"|(?P<word>{_WORD})"
)
_KINDS = {
    **dict.fromkeys(("sec", "section", "chap", "chapter", "ch"), "section"),
    **dict.fromkeys(("eq", "eqn", "formula"), "equation"),
    **dict.fromkeys(("th", "thm"), "theorem"),
    "fig": "figure",
    "def": "definition",
}


class Term(NamedTuple):
    """One term of a query.

    Attributes
    ----------
    kind : str
        ``word``, ``id``, ``section``, ``any`` (a number that may be a section or an equation), or what has numbers in
        the notes, such as ``equation``.
    text : str
        The text in lower case.
    reference : Reference or None
        The numbers of the notes that are meant.
    """

    kind: str
    text: str
    reference: Reference | None = None


def terms_of(text: str, language: str = ENGLISH) -> list[Term]:
    """Return the terms of a query in a language; words without meaning only when there are no others.

    >>> [(term.kind, term.text) for term in terms_of("Rodrigues' formula (3.46)")]
    [('word', 'rodrigues'), ('equation', '3.46')]
    """
    skipped, numbered = _own_words(language)
    asked = _ARTICLE.sub("", plain(text, signs=True))
    asked = _BEFORE_NUMBER.sub(lambda word: numbered.get(word[0], word[0]), asked)
    found = [_term(match) for match in _TERM.finditer(asked)]
    telling = [term for term in found if term.kind != "word" or term.text not in skipped]
    return telling or found


@cache
def _own_words(language: str) -> tuple[frozenset[str], Mapping[str, str]]:
    """Return the words of a language without meaning, and those before numbers, each with the English one."""
    words = words_in(language)
    skipped = frozenset(plain(f"{SKIPPED} {words(SKIPPED)}").split())
    return skipped, {plain(words(name)): name for name in NUMBERED}


def _term(found: re.Match[str]) -> Term:
    if found["word"]:
        return Term("word", _POSSESSIVE.sub("", found["word"]).replace("'", ""))
    if found["id"]:
        return Term("id", found["id"])
    number = found["number"].replace(" ", "")
    given = "section" if found["mark"] else found["kind"] or ("equation" if found["open"] else "any")
    kind = _KINDS.get(given, given)
    if kind == "any" and "." not in number and number not in chapters():
        return Term("word", number)
    cited = reference(kind if kind in KINDS else "equation", number)
    if kind in KINDS and cited is None:
        return Term("section", number)
    return Term(kind, number, None if kind == "section" else cited)


def plain(text: str, *, signs: bool = False) -> str:
    """Return text in lower case without accents, Greek letters by name; without ``signs`` only words and spaces.

    >>> plain("Čapek: R.U.R.")
    'capek r u r'
    """
    folded = unicodedata.normalize("NFKD", text.translate(_SIGNS).casefold().translate(_SIGNS))
    bare = "".join(letter for letter in folded if not unicodedata.combining(letter))
    return bare if signs else " ".join(re.findall(r"[^\W_]+", bare))


def tokens(text: str) -> Iterator[str]:
    """Yield the words of a text in lower case; those with a hyphen also as one.

    >>> list(tokens("Newton's pseudo-inverse"))
    ['newton', 'pseudo', 'inverse', 'pseudoinverse']
    """
    for word in re.findall(_WORD, _ARTICLE.sub("", plain(text, signs=True)).replace("_", " ")):
        parts = _POSSESSIVE.sub("", word).replace("'", "").split("-")
        yield from parts
        if len(parts) > 1:
            yield "".join(parts)


def without_one(word: str) -> set[str]:
    """Return a word and all forms of it with one letter removed: two words one slip apart have one in common."""
    return {word, *(word[:i] + word[i + 1 :] for i in range(len(word)))}


def one_slip(a: str, b: str) -> bool:
    """Return whether one letter is left out, added or mistaken, or two neighbours are exchanged.

    >>> one_slip("jacobian", "jacobain"), one_slip("rodriges", "rodrigues"), one_slip("axis", "axes")
    (True, True, True)
    """
    start = next((i for i, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b)))
    a, b = a[start:], b[start:]
    return a != b and (a[1:] == b or a == b[1:] or a[1:] == b[1:] or (a[:2] == b[1::-1] and a[2:] == b[2:]))
