"""The door by which texts leave for a page that speaks another language; pages in English have none.

Each page whose student reads another language gets a `Speech` of its own, through which its messages go. Markup is cut
into runs: texts with the elements that stand in a line with them, such as bold words and formulas. A run is looked up
as one text (`armlab.content.words`), so that a translation may put its elements in another order.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from html import unescape
from typing import Any, NamedTuple

from markupsafe import escape

from armlab.content.as_written import STAYS
from armlab.content.languages import ENGLISH, words_in
from armlab.content.stand_ins import HELD, NUMBER, with_numbers, without_numbers
from armlab.content.words import Words, has_words
from armlab.ui.drawing_texts import said_drawing

_TOKEN = re.compile(r"<(math|style|textarea|pre|output)\b.*?</\1>|<[^>]*>|[^<]+", re.DOTALL)
_LIVE = re.compile(r"(<output\b[^>]*>)([^<]*)(?=</output>)")
_NAME = re.compile(r"</?([a-zA-Z0-9]+)")
_SAID = re.compile(r' (title|aria-label|placeholder|label|alt|aria-valuetext|data-name|data-title|data-ask)="([^"]*)"')
_HELD = re.compile(r"\{(\d+)\}|<(\d+)/>|<(\d+)>(.*?)</\3>", re.DOTALL)

_SPOKEN = re.compile(rf'((?: lang="|[?]lang=)){ENGLISH}\b')
"""The language of an element, or of the page to which an address leads."""

_STAYS = ' {}="{}"'.format(*STAYS)
"""Attribute of an element whose texts are not translated."""

_DATA = re.compile(r' (data-(?:pages|notes|bring|tray|picture))="([^"]*)"')
_LINES = re.compile(r"\s*\n\s*")
_COPY = re.compile(r'\[title="([^"]*)"\]')

SHOWN = frozenset({"title", "name", "x", "y", "page", "tab", "hidden", "arm"})
"""Names of the values in a page's data, told as JSON, that it shows or that are titles of tabs."""

INLINE = frozenset(
    {"a", "abbr", "b", "code", "em", "i", "kbd", "math", "output", "small", "span", "strong", "sub", "sup", "u", "var"}
)
"""Elements that stand in a line with the text around them."""

EMPHASIS = ("<strong", "<em")
"""Beginnings of the elements that emphasise words of a sentence in the texts of lessons."""

LINK = 'class="erratum"'
"""Attribute of the buttons that do so, too: links in the texts of lessons, see `armlab.ui.erratum_links`."""

MOST_KEPT = 8192
"""Largest number of runs of markup whose translation is kept."""


class _Piece(NamedTuple):
    """A piece of a run: a text with neither start nor end, or an element; one without words is all `start`."""

    start: str
    inside: tuple[_Piece, ...]
    end: str
    text: str = ""


class Speech:
    """The texts of one language, for texts and for markup.

    Parameters
    ----------
    words : Words
    language : str
        Its key, which takes the place of that of English where an element or an address tells it.
    """

    def __init__(self, words: Words, language: str = ENGLISH) -> None:
        self._words, self._language = words, language
        self._runs: dict[str, str] = {}

    def text(self, text: str) -> str:
        """Return a text in the language, or as it is where it is not known."""
        return self._words(text)

    def markup(self, html: str) -> str:
        """Return markup in the language: all its texts, and those that are shown under the pointer or read aloud."""
        made: list[str] = []
        run: list[str] = []
        linked = False
        for token in _tokens(html):
            name = _NAME.match(token)
            button = name is not None and name[1] == "button"
            begins, ends = button and LINK in token, button and linked
            if name is None or name[1] in INLINE or begins or ends:
                linked = begins or (linked and not ends)
                run.append(token)
                continue
            if run:
                made.append(self._run("".join(run)))
                run.clear()
            made.append(token if _stays(token) else self._attributes(token))
        if run:
            made.append(self._run("".join(run)))
        return "".join(made)

    def whole(self, token: str) -> str:
        """Return an element that is held as a whole, such as a formula; a value that is in words is said."""
        return token if _stays(token) else _LIVE.sub(self._value, token)

    def _value(self, found: re.Match[str]) -> str:
        return f"{found[1]}{escape(self.text(unescape(found[2])))}"

    def _attributes(self, token: str) -> str:
        """Return an element's start with those of its attributes that a person reads."""
        if '="' not in token:
            return token
        if token.startswith("<img "):
            token = said_drawing(token, self._words)
        if "lang=" in token:
            token = _SPOKEN.sub(lambda spoken: f"{spoken[1]}{self._language}", token)
        if _DATA.search(token):
            return _DATA.sub(lambda data: f' {data[1]}="{escape(self._data(data[1], unescape(data[2])))}"', token)
        return _SAID.sub(lambda said: f' {said[1]}="{escape(self._words(unescape(said[2])))}"', token)

    def _data(self, name: str, text: str) -> str:
        """Return what the page's script is told, with the texts in it that it shows or goes by."""
        said = json.loads(text)
        if name == "data-pages":
            said = {self.text(tab): "\n".join(map(self.text, inside.split("\n"))) for tab, inside in said.items()}
        elif name == "data-bring":
            said["at"] = _COPY.sub(lambda copy: f'[title="{self.text(copy[1])}"]', said["at"])
        else:
            said = self._in_data(said)
        return json.dumps(said)

    def _in_data(self, data: Any) -> Any:
        if isinstance(data, list):
            return [self._in_data(each) for each in data]
        if not isinstance(data, dict):
            return data
        return {key: self._shown(value) if key in SHOWN else self._in_data(value) for key, value in data.items()}

    def _shown(self, value: Any) -> Any:
        if isinstance(value, list):
            return [self._shown(each) for each in value]
        if not isinstance(value, str):
            return self._in_data(value)
        return self.markup(value) if "<" in value else self.text(value)

    def _run(self, run: str) -> str:
        known = self._runs.get(run)
        if known is None:
            if len(self._runs) >= MOST_KEPT:
                self._runs.clear()
            known = self._runs[run] = self._said(_pieces(run, self)) if has_words(run) else run
        return known

    def _said(self, pieces: tuple[_Piece, ...], told: bool = False) -> str:
        """Return pieces in the language: as one text if there is one around elements, otherwise one by one.

        Where a text around elements is not known, the others and emphasised words stay as they are too, except names
        of the lab's controls: no sentence is half in English, and what it names is called as on the page.

        Parameters
        ----------
        pieces : tuple of _Piece
        told : bool
            Whether it has been told already that a text around them is missing.
        """
        if any(has_words(piece.text) for piece in pieces):
            holder = _Holder()
            whole = holder.hold(pieces)
            found = None if holder.strange else (self._words.find if told else self._words.say)(whole)
            if found is not None:
                return holder.filled(found, self)
            told = True
        stays = any(self._is_unknown(piece) for piece in pieces)
        return "".join([self._alone(piece, told, stays) for piece in pieces])

    def _is_unknown(self, piece: _Piece) -> bool:
        """Tell whether a piece is a text with words that are not known."""
        return has_words(piece.text) and self._words.find(without_numbers(unescape(piece.text)).text) is None

    def _alone(self, piece: _Piece, told: bool, stays: bool = False) -> str:
        """Return one piece in the language; where its sentence stays, so do all its texts and what it emphasises."""
        if piece.start:
            emphasised = piece.start.startswith(EMPHASIS) and not _names_a_control(piece)
            inside = "".join(map(_as_it_is, piece.inside)) if stays and emphasised else self._said(piece.inside, told)
            return f"{piece.start}{inside}{piece.end}"
        if stays:
            return piece.text
        plain = without_numbers(unescape(piece.text))
        found = self._words.find(plain.text)
        return piece.text if found is None else str(escape(with_numbers(found, plain.numbers)))


@cache
def speech_in(language: str) -> Speech:
    """Return the texts of a language, the same for all pages: what is kept of them is not personal."""
    return Speech(words_in(language), language)


class _Holder:
    """A text of pieces without its numbers and elements, and these."""

    def __init__(self) -> None:
        self._numbers: list[str] = []
        self._elements: list[_Piece] = []
        self.strange = False

    def hold(self, pieces: tuple[_Piece, ...]) -> str:
        """Return the text of pieces, with what stands for numbers and elements."""
        return "".join([self._one(piece) for piece in pieces])

    def _one(self, piece: _Piece) -> str:
        if not piece.start:
            text = _LINES.sub(" ", unescape(piece.text))
            self.strange = self.strange or HELD.search(text) is not None
            return NUMBER.sub(self._number, text)
        place = len(self._elements)
        self._elements.append(piece)
        inside = self.hold(piece.inside) if _has_words(piece) else ""
        return f"<{place}>{inside}</{place}>" if inside else f"<{place}/>"

    def _number(self, found: re.Match[str]) -> str:
        self._numbers.append(found[0])
        return f"{{{len(self._numbers) - 1}}}"

    def filled(self, text: str, speech: Speech) -> str:
        """Return the markup of a translated text."""
        made, last = [], 0
        for held in _HELD.finditer(text):
            made.append(str(escape(text[last : held.start()])))
            last = held.end()
            if held[1] is not None:
                made.append(self._numbers[int(held[1])])
            elif held[2] is not None:
                piece = self._elements[int(held[2])]
                made.append(f"{piece.start}{speech._said(piece.inside)}{piece.end}")
            else:
                piece = self._elements[int(held[3])]
                made.append(f"{piece.start}{self.filled(held[4], speech)}{piece.end}")
        return "".join([*made, str(escape(text[last:]))])


def _has_words(piece: _Piece) -> bool:
    return has_words(piece.text) or any(_has_words(each) for each in piece.inside)


def _as_it_is(piece: _Piece) -> str:
    return f"{piece.start}{''.join(map(_as_it_is, piece.inside))}{piece.end}{piece.text}"


def _names_a_control(piece: _Piece) -> bool:
    """Tell whether a piece is the name of a control or a page in a lesson: set in italics, with a capital letter."""
    return piece.start.startswith("<em") and any(each.text[:1].isupper() for each in piece.inside[:1])


def _pieces(run: str, speech: Speech) -> tuple[_Piece, ...]:
    """Return the pieces of a run; an element that begins or ends outside it is left as it is."""
    stack: list[tuple[str, list[_Piece]]] = [("", [])]
    for token in _tokens(run):
        if not token.startswith("<"):
            stack[-1][1].append(_Piece("", (), "", token))
        elif token.startswith("</") and len(stack) > 1:
            start, inside = stack.pop()
            stack[-1][1].append(_Piece(start, tuple(inside), token))
        elif token.startswith("</") or token.count("<") > 1:
            stack[-1][1].append(_Piece(speech.whole(token), (), ""))
        else:
            stack.append((speech._attributes(token), []))
    while len(stack) > 1:
        start, inside = stack.pop()
        stack[-1][1].append(_Piece(start, (), ""))
        stack[-1][1].extend(inside)
    return tuple(stack[0][1])


def _tokens(html: str) -> Iterator[str]:
    """Yield texts, and starts and ends of elements; one whose texts stay is yielded as a whole."""
    end = 0
    for found in _TOKEN.finditer(html):
        if found.start() < end:
            continue
        end = _end_of(html, found) if _stays(found[0]) else found.end()
        yield html[found.start() : end]


def _stays(token: str) -> bool:
    return _STAYS in token and token.startswith("<")


def _end_of(html: str, start: re.Match[str]) -> int:
    """Return the end of an element, behind its own end and those of elements of its kind in it."""
    name, depth = _NAME.match(start[0]), 1
    same = re.compile(rf"<(/?){name[1] if name else ''}\b[^>]*>")
    for found in same.finditer(html, start.end()):
        depth += -1 if found[1] else 1
        if not depth:
            return found.end()
    return start.end()
