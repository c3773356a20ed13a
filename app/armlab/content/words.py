r"""The words of a language: texts of the lab are looked up in a catalogue whose sources are the English texts.

The lab's pages say some 3300 texts as they open, half of them with numbers or names in them, and some 5500 when all is
pressed on them. They stand in its code, in English, and are not marked there. Whatever reaches a person leaves by one
door, the messages to that person's page (`armlab.ui.door`), and is looked up there: so no page knows of languages,
nothing is done for English, and a language belongs to one connection and cannot reach another. A text is looked up
without its numbers:

``{0}``, ``{1}``
    stand for its numbers in their order, so that "2 of 8 solutions" is found as ``{0} of {1} solutions``;
``<0>...</0>``, ``<0/>``
    for elements in it, in their order: with words inside, or without, such as a formula or a symbol;
``{name}``
    in the source of a message stands for any text, which is itself looked up: ``Undo: {what}``; where the name begins
    with "text", only a text that is known or has no words; where it begins with "typed", it stays as a person typed it.

A text in radians or metres is found as the same one in degrees or millimetres is, whose units it has then.

Signs, units and formulas around a text are no part of it. A text that is not found as a whole is looked up by its
sentences and by the items of its list. A text that is not found at all stays English. The form of a catalogue is
gettext's ``.po``; ``armlab/languages/it.po`` is that of Italian, and ``python tests/words.py it`` renews it from what
all pages say. A lesson's texts are such messages too, in a file of their own, ``lessons/it/NAME.po``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from armlab.content.as_written import is_part
from armlab.content.named_messages import Caught, NamedMessage, in_units, own_numbers
from armlab.content.po import Message
from armlab.content.stand_ins import (
    HELD,
    MOST_KEPT,
    NAME,
    as_in,
    renumbered,
    with_numbers,
    without_numbers,
    without_units,
)

UNIT = r"(?:°|mm|cm|m|rad|s|%|N|W|V|A|Hz|N m|mm²|m²|rpm)(?:/s[²³]?|/mm|/min)?"
"""Pattern of a unit behind a text."""

JOINS = ("and", "or")
"""Conjunctions."""

_WORD = re.compile(r"[A-Za-zÀ-ÿ]{2,}")
_AROUND = re.compile(
    r"((?:<\d+/>|[^\w<{(“\[⟨∂ẋ]+ |\s)*)"
    r"(.*?)"
    rf"((?:<\d+/>|\s|,?[ \u00a0](?:in )?{UNIT}|[…:›]| \.\.\.)*)",
    re.DOTALL,
)
_AXES = re.compile("[xyz]+")
_BETWEEN = re.compile(r"(?<=[.!?…:;]) +(?=[A-Z“<{(])| · | — | › |\n+")
_HEAD = re.compile(r"(</\d+>)(?=[A-ZΑ-ω“{(])")
_ASIDE = re.compile(r".+?(<(\d+)>(?:(?!</\2>).)*</\2>)", re.DOTALL)
_WRAPPED = re.compile(r"(<(\d+)>)((?:(?!</?\2>).)*)(</\2>)", re.DOTALL)

_SAME = """
    mm cm km rad deg kg Nm mNm Ns mA mW kW Hz kHz rpm min max sin cos tan atan det diag tr exp log ln sqrt sgn sign
    DH PID SVD DLS IK FK TCP RPY UR PUMA SCARA CSV JSON LaTeX Python NumPy MATLAB SVG PNG TOML STL URDF GLB
    Ctrl Esc Enter Shift Tab Alt Home End PgUp PgDn px py pz qx qy qz dq ms II III IV PPR WS SO SE arg dim mod
    XYZ XZY YXZ YZX ZXY ZYX XYX XZX YXY YZY ZXZ ZYZ SciPy Newton Broyden Euler arccos arcsin arctan
"""

NO_WORDS = frozenset(_SAME.split())
"""Words that are the same in every language: units, functions, formats, keys."""

LONGEST, LONGEST_NAMED = 3000, 300
"""Most characters of a text that is looked up, and of one that is compared with messages with names: what is longer
comes from people, who may write anything, and a text is taken apart in a time that grows with its square."""


def has_words(text: str) -> bool:
    """Return whether a text has words: symbols, units and names of functions are the same in every language."""
    return any(word not in NO_WORDS and not _AXES.fullmatch(word) for word in _WORD.findall(text))


def _core(text: str) -> tuple[str, str, str]:
    """Return what stands before a text, the text itself, and what stands behind it: signs, units and formulas.

    >>> _core("✓ Duration of the move in s<0/>")
    ('✓ ', 'Duration of the move', ' in s<0/>')
    """
    match = _WRAPPED.fullmatch(text)
    if match is not None:
        return match[1], match[3], match[4]
    match = _AROUND.fullmatch(text)
    return ("", text, "") if match is None or not match[2] else (match[1], match[2], match[3])


class Words:
    """The words of one language. Safe to use from several threads.

    Parameters
    ----------
    messages : iterable of Message
        Of these the ones that are translated count.
    on_miss : callable, optional
        Called with each text that is not found.
    on_hit : callable, optional
        Called with the source of each message that is found.
    """

    def __init__(
        self,
        messages: Iterable[Message],
        on_miss: Callable[[str], None] = lambda text: None,
        on_hit: Callable[[str], None] = lambda source: None,
    ) -> None:
        self._texts: dict[str, str] = {}
        self._in_any_units: dict[str, str] = {}  # sources by what they are without units
        self._named: list[NamedMessage] = []
        self._known: dict[str, str | None] = {}
        self._on_miss, self._on_hit = on_miss, on_hit
        for message in messages:
            if not message.text or message.fuzzy:
                continue
            if NAME.search(message.source):
                self._named.append(NamedMessage.of(message))
            else:
                self._texts[message.source] = message.text
                unitless, units = without_units(message.source)
                if units:
                    self._in_any_units.setdefault(unitless, message.source)
        # Of several that fit, the one that says most of the text is meant.
        self._named.sort(key=lambda each: -each.words)

    def __call__(self, text: str) -> str:
        """Return a text in the language, or as it is where it is not known.

        >>> Words([Message("{0} of {1}", "{0} su {1}")])("2 of 8")
        '2 su 8'
        """
        if len(text) > LONGEST or not has_words(text) or HELD.search(text):
            return text
        plain = without_numbers(text)
        found = self.say(plain.text)
        return text if found is None else with_numbers(found, plain.numbers)

    def say(self, text: str) -> str | None:
        """Return the translation of a text without its numbers; None, which is told, where there is none."""
        found = self.find(text)
        if found is None and len(text) <= LONGEST and has_words(text):
            self._miss(text)
        return found

    def _miss(self, text: str) -> None:
        """Tell that a text is not found, by its parts."""
        parts = [text[first:end] for first, end in _parts(text)]
        core = _core(parts[0])[1] if len(parts) == 1 else ""
        if has_words(core):
            self._on_miss(renumbered(core)[0])
        for part in parts[1:] and parts:
            self.say(part)

    def find(self, text: str) -> str | None:
        """Return the translation of a text without its numbers; None where there is none."""
        if text in self._known:
            return self._known[text]
        if is_part(text):
            return text
        found = self._find(text) if len(text) <= LONGEST and has_words(text) else None
        if len(self._known) >= MOST_KEPT:
            self._known.clear()
        self._known[text] = found
        return found

    def _find(self, text: str) -> str | None:
        start, core, end = _core(text)
        found = self._exact(text)
        if found is None and core != text:  # says more than a message with names that fits the signs as well
            for piece, before, behind in ((f"{core}{end}", start, ""), (core, start, end)):
                if (inside := self._exact(piece)) is not None:
                    return f"{before}{inside}{behind}"
        if found is None:
            found = self._with_names(text)
        if found is None and core != text:
            inside = self.find(core)
            return None if inside is None else f"{start}{inside}{end}"
        if found is None:
            found = self._in_pieces(text, _parts(text))
        if found is None:
            found = self._in_pieces(text, _sentences(text))
        return self._in_pieces(text, _listed(text), whole=True) if found is None else found

    def _exact(self, text: str) -> str | None:
        """Return the translation of a message, with the numbers that it has in the text.

        A message that begins small is found at the beginning of a sentence, too.
        """
        source, back = renumbered(text)
        small = f"{source[:1].lower()}{source[1:]}"
        known = next((each for each in (source, small) if each in self._texts), None)
        if known is None:
            found = self._in_other_units(source)
            return None if found is None else as_in(found, back)
        self._on_hit(known)
        found = as_in(self._texts[known], back)
        return found if known == source else f"{found[:1].upper()}{found[1:]}"

    def _in_other_units(self, source: str) -> str | None:
        """Return the translation of a message that differs in its units only, with those of the text."""
        unitless, units = without_units(source)
        known = self._in_any_units.get(unitless) if units else None
        says = None if known is None else in_units(self._texts[known], known, units)
        if known is not None and says is not None:
            self._on_hit(known)
        return says

    def _with_names(self, text: str) -> str | None:
        """Return the translation of a message with names, with the numbers and the names of the text."""
        source, back = renumbered(text)
        on = None
        for message in self._named if len(source) <= LONGEST_NAMED else ():
            caught = message.caught(source)
            if caught is None or not self._fits(caught, back):
                continue
            if not caught.goes_on:
                return self._taken(message, caught, back)
            on = on or (message, caught)
        # A person may type a full stop, so that a message goes on only over sentences that are not known.
        found = None if on is None else self._in_pieces(text, _sentences(text), whole=True)
        return self._taken(*on, back) if found is None and on is not None else found

    def _taken(self, message: NamedMessage, caught: Caught, back: dict[str, str]) -> str:
        """Return the translation of a message with names that fits, which is told."""
        self._on_hit(message.source)
        return self._filled(caught, back)

    def _filled(self, caught: Caught, back: dict[str, str]) -> str:
        """Return the translation of a message with names, each of them looked up, and with the numbers of the text."""

        def named(name: re.Match[str]) -> str:
            inside = as_in(caught.inside[name[1]], back)
            return inside if name[1].startswith("typed") else self.find(inside) or inside

        return NAME.sub(named, own_numbers(caught, back))

    def _fits(self, caught: Caught, back: dict[str, str]) -> bool:
        """Return whether all is known in a text that has to be."""
        held = [as_in(text, back) for name, text in caught.inside.items() if name.startswith("text")]
        # A head and what follows it are no name.
        return all("</" not in text and self._is_known(text) for text in held)

    def _is_known(self, text: str) -> bool:
        """Return whether all of a text is known, or has no words; that a part of it is not is told to nobody."""
        core = _core(text)[1]
        if not has_words(text) or any(self._exact(each) or self._with_names(each) for each in (text, core)):
            return True
        pieces = next((found for found in (_parts(text), _sentences(text), _listed(text)) if len(found) > 1), [])
        return bool(pieces) and all(self._is_known(text[first:end]) for first, end in pieces)

    def _in_pieces(self, text: str, places: list[tuple[int, int]], whole: bool = False) -> str | None:
        """Return the translation of the pieces of a text, where one is known, or, for the whole, where all are."""
        if len(places) < 2:
            return None
        pieces = [text[first:end] for first, end in places]
        found = [self.find(piece) for piece in pieces]
        if not all(found):  # a conjunction alone belongs to the words that are not known
            found = [None if _core(piece)[1] in JOINS else each for piece, each in zip(pieces, found, strict=True)]
        missing = [piece for piece, each in zip(pieces, found, strict=True) if each is None and has_words(piece)]
        if not any(found) or (whole and missing):
            return None
        for piece in missing:
            self._miss(piece)
        made, last = [], 0
        for (first, end), piece, each in zip(places, pieces, found, strict=True):
            made += [text[last:first], piece if each is None else each]
            last = end
        return "".join(made)


def _parts(text: str) -> list[tuple[int, int]]:
    """Return where the parts of a text are: a head, such as that of a card, what follows it, and what stands aside."""
    cuts = [found.end(1) for found in _HEAD.finditer(text) if _is_whole(text[: found.end(1)])]
    aside = _ASIDE.fullmatch(text, cuts[-1] if cuts else 0)
    cuts += [aside.start(1)] if aside and has_words(text[cuts[-1] if cuts else 0 : aside.start(1)]) else []
    return list(zip([0, *cuts], [*cuts, len(text)], strict=True))


def _sentences(text: str) -> list[tuple[int, int]]:
    gaps = [found.span() for found in _BETWEEN.finditer(text) if _is_whole(text[: found.start()])]
    return list(zip([0, *(end for _, end in gaps)], [*(start for start, _ in gaps), len(text)], strict=True))


def _listed(text: str) -> list[tuple[int, int]]:
    gaps = [found.span() for found in re.finditer(", ", text) if _is_whole(text[: found.start()])]
    return list(zip([0, *(end for _, end in gaps)], [*(start for start, _ in gaps), len(text)], strict=True))


def _is_whole(text: str) -> bool:
    """Return whether no element is open at the end of a text."""
    found = [held for held in HELD.finditer(text) if held[3] and not held[4]]
    return 2 * sum(1 for held in found if held[2]) == len(found)
