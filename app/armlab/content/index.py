"""The index of the lab: topics, lessons, pages and other things on a word, a section or an equation of the notes.

A query is split into terms. A number refers to the notes, anything else is a word, found also by its beginning, by a
synonym or with one slip, in English or in the language of who asks. Every term gives points to what it is found in;
what lacks a term is left out, unless everything does.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

from armlab.content.index_items import Entry as Entry
from armlab.content.index_items import Item, Kind, items_of
from armlab.content.index_items import Taught as Taught
from armlab.content.index_items import Thing as Thing
from armlab.content.languages import ENGLISH, words_in
from armlab.content.lessons import Lessons, lessons
from armlab.content.query import Term, one_slip, plain, terms_of, tokens, without_one
from armlab.content.synonyms import singular, synonyms

LIMIT = 20
"""Default of the largest number of results."""

LONGEST = 200
"""Largest number of characters of a query that are used."""

DIRECT, WITHIN, LINKED = 1000.0, 900.0, 800.0
"""Points of a number: for an entry that has it, for the subsections of a section, for what belongs to such a row."""

TITLE, WORDS, PARENT, DETAIL = 100.0, 60.0, 50.0, 20.0
"""Points of a word, by whether it is in a title, the other words, the title of what it is a part of, or the details."""

MOST_OFF = 10
"""Largest number of points that a long title, or another long name, loses: one for each word."""

PLURAL, SYNONYM, BEGINNING, SLIP = 0.95, 0.85, 0.6, 0.5
"""Factor for a word in the other number, for another word that means the same, for one of which only the beginning was
typed, and for one with a slip."""

WHOLE_TITLE, WHOLE_NAME = 40.0, 35.0
"""Additional points when the whole query is a title, or one of the other names."""

WHOLE_PHRASE = 60.0
"""Additional points when it is another name, of several words, of a file: who types "hand in" looks for no hand."""

WORTH: Mapping[Kind, float] = {
    "setting": 0.65,
    "lesson": 0.6,
    "export": 0.6,
    "chapter": 0.55,
    "row": 0.55,
    "function": 0.4,
}
"""Factor for the points of words by kind, 1 for the others: who types a word wants to go where it can be seen or done
before reading of it, and hardly ever wants code."""

SHARE: Mapping[Kind, float] = {"lesson": 0.7, "bench": 0.6, "function": 0.5}
"""Fractions of the points of a row that are given to what belongs to it."""

SHORTEST_SLIP = 4
"""Length of the shortest word, in letters, in which a slip is allowed."""

SHOWS_DETAIL: tuple[Kind, ...] = ("arm", "function")
"""Kinds that are found also by the words of their line."""

Place = tuple[str, str]
"""Kind and key of an entry."""


def search(
    text: str,
    limit: int = LIMIT,
    *,
    things: Iterable[Thing] = (),
    taught: Iterable[Taught] | None = None,
    hidden: Collection[Place] = frozenset(),
    language: str = ENGLISH,
) -> list[Entry]:
    """Return the entries on words, sections or equations, the best first.

    Parameters
    ----------
    text : str
        Such as ``3.66``, ``eq (3.66)``, ``section 4.1``, ``theorem 2``, ``S4.1-dh`` or ``forward kinematics``. Without
        anything to look for the chapters are returned.
    limit : int
        Most entries.
    things : iterable of Thing
        Pages, arms, commands and whatever else of the lab can be found, which content itself does not know.
    taught : iterable of Taught, optional
        The lessons; those of the lab when left out.
    hidden : collection of (str, str)
        Kind and key of what is not to be found now.
    language : str
        Key of a language whose words are understood besides the English ones. The entries are in English.

    Returns
    -------
    list of Entry
        Ordered by points, then by kind, then as in the notes; the same for the same query.

    Examples
    --------
    >>> [entry.key for entry in search("3.66")][:1], search("rodriges")[0].title[:10]
    (['S3.2.2-inverse'], "Rodrigues'")
    """
    taught = taught_in(lessons()) if taught is None else tuple(taught)
    return _index(taught, tuple(things), language).search(text[:LONGEST], hidden)[: max(0, limit)]


def taught_in(found: Lessons) -> tuple[Taught, ...]:
    """Return the data of lessons for the index."""
    chapters = {key: title for course in reversed(found.courses) for key, title in course.chapter_of.items()}
    return tuple(
        Taught(each.key, each.title, chapters.get(each.key, each.chapter), each.teaches, each.can, each.minutes)
        for each in found.listed
    )


# --- The index

Points = dict[int, float]
Postings = dict[str, Points]


@dataclass(frozen=True, eq=False)
class _Index:
    language: str
    items: tuple[Item, ...]
    names: tuple[Mapping[str, float], ...]
    words: Postings
    ordered: tuple[str, ...]
    slips: Mapping[str, tuple[str, ...]]
    belonging: Mapping[str, tuple[int, ...]]

    def search(self, text: str, hidden: Collection[Place]) -> list[Entry]:
        terms = terms_of(text, self.language)
        if not terms:
            return [item.entry for item in self.items if item.entry.kind == "chapter"]
        each = [self._shared(self._points(term, len(terms) > 1)) for term in terms]
        total: defaultdict[int, float] = defaultdict(float)
        matched: defaultdict[int, int] = defaultdict(int)
        for points in each:
            for i, value in points.items():
                if self._place(i) not in hidden:
                    total[i] += value
                    matched[i] += 1
        most = max(matched.values(), default=0)
        phrase = plain(text)
        best = {i: value + self.names[i].get(phrase, 0.0) for i, value in total.items() if matched[i] == most}
        order = sorted(best, key=lambda i: (-round(best[i], 6), i))
        return [_without(self.items[i].entry, hidden) for i in order]

    def _place(self, i: int) -> Place:
        entry = self.items[i].entry
        return entry.kind, entry.key

    def _points(self, term: Term, among_others: bool) -> Points:
        if term.kind == "word":
            return self._word(term.text)
        found = {i: points for i, item in enumerate(self.items) if (points := _numbered(item, term)) > 0.0}
        if not found and term.kind == "section" and "." in term.text:
            return self._points(term._replace(text=term.text.rpartition(".")[0]), among_others)
        # Beside a name a number may be a part of it, as in KR 6.
        return {**self._word(term.text), **found} if among_others and term.kind == "any" else found

    def _shared(self, points: Points) -> Points:
        """Add a fraction of the points of rows to what belongs to them."""
        result = dict(points)
        for i, value in points.items():
            entry = self.items[i].entry
            if entry.kind != "row":
                continue
            for j in self.belonging.get(entry.key, ()):
                share = SHARE.get(self.items[j].entry.kind)
                if share is not None:
                    part = value - DIRECT + LINKED if value > LINKED else value * share
                    result[j] = max(result.get(j, 0.0), part)
        return result

    def _word(self, word: str) -> Points:
        best: Points = {}
        for form, worth in self._forms(word):
            _raise(best, self.words[form], worth)
        bare = word.replace("-", "")
        for other in synonyms((bare, singular(bare)), self.language):
            _raise(best, self._all_of(other.replace("-", " ").split()), SYNONYM)
        if "-" in word:
            _raise(best, self._of_parts([self._word(part) for part in word.split("-")]), 1.0)
        return best

    def _all_of(self, words: list[str]) -> Points:
        """Return the points of what has all of some words as they stand."""
        return self._of_parts([self.words.get(word, {}) for word in words])

    def _of_parts(self, parts: list[Points]) -> Points:
        both = set.intersection(*(set(part) for part in parts))
        return {i: sum(part[i] for part in parts) / len(parts) for i in both}

    def _forms(self, word: str) -> Iterator[tuple[str, float]]:
        """Yield indexed words and their factors for a word of the query."""
        word = word.replace("-", "")
        if word in self.words:
            yield word, 1.0
        one = singular(word)
        if one != word and one in self.words:
            yield one, PLURAL
        if len(word) > 1:
            for form in self.ordered[bisect_left(self.ordered, word) :]:
                if not form.startswith(word):
                    break
                yield form, BEGINNING
        if len(word) >= SHORTEST_SLIP:
            near = {form for part in without_one(word) for form in self.slips.get(part, ())}
            yield from ((form, SLIP) for form in near if one_slip(word, form))


def _raise(best: Points, points: Mapping[int, float], worth: float) -> None:
    """Take over points that are more than those there are."""
    for i, value in points.items():
        best[i] = max(best.get(i, 0.0), value * worth)


def _without(entry: Entry, hidden: Collection[Place]) -> Entry:
    """Return an entry without what it leads to that is hidden."""
    if not hidden or entry.kind != "row":
        return entry

    def kept(kind: Kind, keys: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(key for key in keys if (kind, key) not in hidden)

    return replace(entry, lessons=kept("lesson", entry.lessons), benches=kept("bench", entry.benches))


def _numbered(item: Item, term: Term) -> float:
    """Return the points of an item for a number or an id."""
    entry = item.entry
    if term.kind == "id":
        key = entry.key.casefold()
        found = entry.kind == "row" and key.startswith(term.text)
        return 0.0 if not found else DIRECT if key == term.text else WITHIN
    if term.reference is not None and any(own.meets(term.reference) for own in item.references):
        return DIRECT - 1.0 if term.kind == "any" else DIRECT
    if term.kind in ("section", "any"):
        if term.text in item.sections:
            return DIRECT
        if any(section.startswith(f"{term.text}.") for section in item.sections):
            return WITHIN
    return 0.0


@lru_cache(maxsize=8)
def _index(taught: tuple[Taught, ...], things: tuple[Thing, ...], language: str) -> _Index:
    """Return the index of these lessons and things in a language, which is kept between queries."""
    items = items_of(taught, things)
    belonging: defaultdict[str, list[int]] = defaultdict(list)
    for i, item in enumerate(items):
        if item.entry.kind not in ("chapter", "row"):
            for row in item.entry.rows:
                belonging[row].append(i)
    words = _postings(items, language)
    slips: defaultdict[str, list[str]] = defaultdict(list)
    for word in words:
        if len(word) >= SHORTEST_SLIP:
            for part in without_one(word):
                slips[part].append(word)
    return _Index(
        language=language,
        items=items,
        names=tuple(_whole(item, language) for item in items),
        words=words,
        ordered=tuple(sorted(words)),
        slips={part: tuple(whole) for part, whole in slips.items()},
        belonging={row: tuple(found) for row, found in belonging.items()},
    )


def told(item: Item) -> list[tuple[str, float]]:
    """Return the texts by whose words an item is found, and the points of a word in each."""
    entry = item.entry
    texts = [(title, TITLE) for title in (entry.title, *item.names)]
    texts += [*((word, WORDS) for word in item.words), (entry.within, PARENT)]
    return [*texts, (entry.detail, DETAIL)] if entry.kind in SHOWS_DETAIL else texts


def _said(item: Item, text: str, language: str) -> tuple[str, ...]:
    """Return a text of an item, and what it is in a language; code is the same in all."""
    same = language == ENGLISH or item.entry.kind == "function"
    return (text,) if same else (text, words_in(language)(text))


def _whole(item: Item, language: str) -> dict[str, float]:
    """Return the whole queries that find an item, and the points for each."""
    worth = WORTH.get(item.entry.kind, 1.0)
    others = [plain(name) for word in item.words for name in _said(item, word, language)]
    file = item.entry.kind == "export"
    names = {name: WHOLE_PHRASE if file and " " in name else worth * WHOLE_NAME for name in others}
    if item.entry.kind == "function":
        return names
    within, *titles = (_said(item, text, language) for text in (item.entry.within, item.entry.title, *item.names))
    alone = [title for said in titles for title in said]
    whole = [f"{place} {title}" for place, title in zip(within, titles[0], strict=True)]
    return {**names, **dict.fromkeys(map(plain, (*alone, *whole)), WHOLE_TITLE)}


def _postings(items: Iterable[Item], language: str) -> Postings:
    """Return the items that contain each word, with points; a short title counts slightly more."""
    words: defaultdict[str, Points] = defaultdict(dict)
    for i, item in enumerate(items):
        worth = WORTH.get(item.entry.kind, 1.0)
        for said, most in [(said, most) for text, most in told(item) for said in _said(item, text, language)]:
            found = list(tokens(said))
            points = most - min(len(found), MOST_OFF)
            for token in found:
                for form, factor in ((singular(token), PLURAL), (token, 1.0)):
                    words[form][i] = max(words[form].get(i, 0.0), worth * points * factor)
    return dict(words)
