"""The index of the lab: everything on a word, a section or an equation of the notes.

A query is split into terms. A number refers to the notes, anything else is a word, found also by its beginning or with
one slip. Every term gives points to what it is found in; what lacks a term is left out, unless everything does.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, NamedTuple

from armlab import kin
from armlab.content.citations import functions
from armlab.content.lessons import lessons
from armlab.content.query import Term, one_slip, plain, terms_of, tokens, without_one
from armlab.content.rows import SECTION, Reference, Row, chapters, reference, rows

Kind = Literal["chapter", "row", "lesson", "bench", "function"]

LIMIT = 20
"""Default of the largest number of results."""

LONGEST = 200
"""Largest number of characters of a query that are used."""

DIRECT, WITHIN, LINKED = 1000.0, 900.0, 800.0
"""Points of a number: for an entry that has it, for the subsections of a section, for what belongs to such a row."""

TITLE, WORDS, DETAIL = 100.0, 60.0, 20.0
"""Points of a word, by whether it is in the title, the other words or the details."""

MOST_OFF = 20
"""Largest number of points that a long title loses, one for each word."""

BEGINNING, SLIP = 0.8, 0.5
"""Factor for a word of which only the beginning was typed, and for one with a slip."""

WHOLE_TITLE, WHOLE_NAME = 40.0, 15.0
"""Additional points when the whole query is a title, or one of the other names."""

OF_FUNCTIONS = 0.7
"""Factor for the points of words of functions: whoever asks for a topic is not looking for code."""

SHARE = {"lesson": 0.7, "bench": 0.6, "function": 0.5}
"""Fractions of the points of a row that are given to what belongs to it."""

SHORTEST_SLIP = 4
"""Length of the shortest word, in letters, in which a slip is allowed."""


@dataclass(frozen=True)
class Bench:
    """A bench of the lab, as its layer describes it.

    Attributes
    ----------
    key, title : str
    about : tuple of str
        Sections with all that is in them (``"4.1"``), rows (``"S4.1-dh"``), equations (``"(5.139-5.152)"``), words.
    """

    key: str
    title: str
    about: tuple[str, ...] = ()


@dataclass(frozen=True)
class Entry:
    """A result of the index.

    Attributes
    ----------
    kind : "chapter", "row", "lesson", "bench" or "function"
    key : str
        Number of the chapter, id of the row, key of the lesson or the bench, dotted name of the function.
    title, detail : str
    rows : tuple of str
        Ids of the rows it belongs to; of a row its own.
    lessons, benches, functions : tuple of str
        Only of rows: keys of what belongs to them.
    """

    kind: Kind
    key: str
    title: str
    detail: str
    rows: tuple[str, ...] = ()
    lessons: tuple[str, ...] = ()
    benches: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()


class Taught(NamedTuple):
    """The data of a lesson for the index."""

    key: str
    title: str
    chapter: str
    teaches: tuple[str, ...]


def search(
    text: str, limit: int = LIMIT, *, benches: Iterable[Bench] = (), taught: Iterable[Taught] | None = None
) -> list[Entry]:
    """Return the entries on words, sections or equations, the best first.

    Parameters
    ----------
    text : str
        Such as ``3.66``, ``eq (3.66)``, ``section 4.1``, ``theorem 2``, ``S4.1-dh`` or ``forward kinematics``. Without
        anything to look for the chapters are returned.
    limit : int
        Most entries.
    benches : iterable of Bench
        The existing benches, which content itself does not know.
    taught : iterable of Taught, optional
        The lessons; those of the lab when left out.

    Returns
    -------
    list of Entry
        Ordered by points, then by kind, then as in the notes; the same for the same query.

    Examples
    --------
    >>> [entry.key for entry in search("3.66")][:1], search("rodriges")[0].title[:10]
    (['S3.2.2-inverse'], "Rodrigues'")
    """
    if taught is None:
        found = lessons().lessons.values()
        taught = (Taught(lesson.key, lesson.title, lesson.chapter, lesson.teaches) for lesson in found)
    return _index(tuple(taught), tuple(benches)).search(text[:LONGEST])[: max(0, limit)]


# --- The index


@dataclass(frozen=True)
class _Item:
    """An entry together with the words and numbers by which it is found."""

    entry: Entry
    words: tuple[str, ...] = ()
    references: tuple[Reference, ...] = ()
    sections: tuple[str, ...] = ()


Points = dict[int, float]
Postings = dict[str, Points]


@dataclass(frozen=True, eq=False)
class _Index:
    items: tuple[_Item, ...]
    names: tuple[Mapping[str, float], ...]
    words: Postings
    ordered: tuple[str, ...]
    slips: Mapping[str, tuple[str, ...]]
    belonging: Mapping[str, tuple[int, ...]]

    def search(self, text: str) -> list[Entry]:
        terms = terms_of(text)
        if not terms:
            return [item.entry for item in self.items if item.entry.kind == "chapter"]
        each = [self._shared(self._points(term)) for term in terms]
        total: defaultdict[int, float] = defaultdict(float)
        matched: defaultdict[int, int] = defaultdict(int)
        for points in each:
            for i, value in points.items():
                total[i] += value
                matched[i] += 1
        most = max(matched.values(), default=0)
        phrase = plain(text)
        best = {i: value + self.names[i].get(phrase, 0.0) for i, value in total.items() if matched[i] == most}
        order = sorted(best, key=lambda i: (-round(best[i], 6), i))
        return [self.items[i].entry for i in order]

    def _points(self, term: Term) -> Points:
        if term.kind == "word":
            return self._word(term.text)
        found = {i: points for i, item in enumerate(self.items) if (points := _numbered(item, term)) > 0.0}
        if not found and term.kind == "section" and "." in term.text:
            return self._points(term._replace(text=term.text.rpartition(".")[0]))
        return found

    def _shared(self, points: Points) -> Points:
        """Add a fraction of the points of rows to what belongs to them."""
        result = dict(points)
        for i, value in points.items():
            entry = self.items[i].entry
            if entry.kind != "row":
                continue
            for j in self.belonging.get(entry.key, ()):
                kind = self.items[j].entry.kind
                part = value - DIRECT + LINKED if value > LINKED else value * SHARE[kind]
                result[j] = max(result.get(j, 0.0), part)
        return result

    def _word(self, word: str) -> Points:
        best: Points = {}
        for form, worth in self._forms(word):
            for i, points in self.words[form].items():
                best[i] = max(best.get(i, 0.0), points * worth)
        if "-" in word:
            parts = [self._word(part) for part in word.split("-")]
            for i in set.intersection(*(set(part) for part in parts)):
                best[i] = max(best.get(i, 0.0), sum(part[i] for part in parts) / len(parts))
        return best

    def _forms(self, word: str) -> Iterator[tuple[str, float]]:
        """Yield indexed words and their factors for a word of the query."""
        word = word.replace("-", "")
        if word in self.words:
            yield word, 1.0
        if len(word) > 1:
            for form in self.ordered[bisect_left(self.ordered, word) :]:
                if not form.startswith(word):
                    break
                yield form, BEGINNING
        if len(word) >= SHORTEST_SLIP:
            near = {form for part in without_one(word) for form in self.slips.get(part, ())}
            yield from ((form, SLIP) for form in near if one_slip(word, form))


def _numbered(item: _Item, term: Term) -> float:
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
def _index(taught: tuple[Taught, ...], benches: tuple[Bench, ...]) -> _Index:
    """Return the index of these lessons and benches, which is kept between queries."""
    others = [*map(_lesson_item, taught), *map(_bench_item, benches), *_function_items()]
    of_row: defaultdict[str, list[_Item]] = defaultdict(list)
    for item in others:
        for row in item.entry.rows:
            of_row[row].append(item)
    own = [_row_item(row, of_row[row.id]) for row in rows().values()]
    items = (*(_chapter_item(key, own) for key in chapters()), *own, *others)
    place = {id(item): i for i, item in enumerate(items)}
    words = _postings(items)
    slips: defaultdict[str, list[str]] = defaultdict(list)
    for word in words:
        if len(word) >= SHORTEST_SLIP:
            for part in without_one(word):
                slips[part].append(word)
    return _Index(
        items=items,
        names=tuple(map(_whole, items)),
        words=words,
        ordered=tuple(sorted(words)),
        slips={part: tuple(whole) for part, whole in slips.items()},
        belonging={row: tuple(place[id(item)] for item in found) for row, found in of_row.items()},
    )


def _chapter_item(key: str, own: Iterable[_Item]) -> _Item:
    """Return a chapter with the numbers of what it contains."""
    entries = [item.entry for item in own if rows()[item.entry.key].chapter == key]
    counts = [_count(len(entries), "topic", "topics")]
    for kind, one, many in (("lessons", "lesson", "lessons"), ("functions", "function", "functions")):
        number = len({name for entry in entries for name in getattr(entry, kind)})
        counts += [_count(number, one, many)] if number else []
    entry = Entry("chapter", key, chapters()[key], ", ".join(counts), tuple(entry.key for entry in entries))
    return _Item(entry, sections=(key,))


def _count(number: int, one: str, many: str) -> str:
    return f"{number} {one if number == 1 else many}"


def _row_item(row: Row, belonging: Iterable[_Item]) -> _Item:
    of = {kind: tuple(item.entry.key for item in belonging if item.entry.kind == kind) for kind in SHARE}
    title = chapters()[row.section] if row.section in ("A", "R") else f"Section {row.section}"
    equations = "equation" if len(row.equations) == 1 and "-" not in row.equations[0] else "equations"
    cited = ([f"{equations} {', '.join(row.equations)}"] if row.equations else []) + list(row.numbered)
    entry = Entry(
        "row", row.id, row.title, "; ".join([title, *cited]), (row.id,), of["lesson"], of["bench"], of["function"]
    )
    return _Item(entry, row.words, row.references, (row.section,))


def _lesson_item(lesson: Taught) -> _Item:
    entry = Entry("lesson", lesson.key, lesson.title, lesson.chapter, lesson.teaches)
    return _Item(entry)


def _bench_item(bench: Bench) -> _Item:
    """Return a bench; it is found by sections, rows, equations in brackets, or words."""
    sections = tuple(about for about in bench.about if SECTION.fullmatch(about))
    cited = [reference("equation", about[1:-1]) for about in bench.about if about.startswith("(")]
    references = tuple(one for one in cited if one is not None)
    words = tuple(
        about for about in bench.about if about not in sections and about not in rows() and not about.startswith("(")
    )
    belongs = tuple(
        row.id
        for row in rows().values()
        if row.id in bench.about
        or any(row.section == section or row.section.startswith(f"{section}.") for section in sections)
        or any(row.cites(one) for one in references)
    )
    entry = Entry("bench", bench.key, bench.title, ", ".join(words), belongs)
    return _Item(entry, words, references, sections)


def _function_items() -> Iterator[_Item]:
    """Yield functions; each belongs to the rows whose equations it cites, or to those of its section without any."""
    by_equation = {
        row.id: [one.name for one in functions() if any(map(row.cites, one.cites.references))]
        for row in rows().values()
    }
    for one in functions():
        belongs = tuple(
            row.id
            for row in rows().values()
            if one.name in by_equation[row.id] or (not by_equation[row.id] and row.section in one.cites.sections)
        )
        title = one.name.removeprefix(f"{kin.__name__}.").rpartition(".")[2]
        entry = Entry("function", one.name, title, one.says, belongs)
        yield _Item(entry, (), one.cites.references, one.cites.sections)


def _whole(item: _Item) -> dict[str, float]:
    """Return the whole queries that find an item, and the points for each."""
    names = {plain(word): WHOLE_NAME for word in item.words}
    return names if item.entry.kind == "function" else {**names, plain(item.entry.title): WHOLE_TITLE}


def _postings(items: Iterable[_Item]) -> Postings:
    """Return the items that contain each word, with points; a short title counts slightly more."""
    words: defaultdict[str, Points] = defaultdict(dict)
    for i, item in enumerate(items):
        title = list(tokens(item.entry.title))
        detail = item.entry.detail if item.entry.kind == "function" else ""
        others = (token for word in item.words for token in tokens(word))
        fields = ((title, TITLE - min(len(title), MOST_OFF)), (others, WORDS), (tokens(detail), DETAIL))
        part = OF_FUNCTIONS if item.entry.kind == "function" else 1.0
        for found, points in fields:
            for token in found:
                words[token][i] = max(words[token].get(i, 0.0), part * points)
    return dict(words)
