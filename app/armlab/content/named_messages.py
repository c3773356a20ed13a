"""Messages with names: ``Undo: {what}`` fits any text with these words, in whatever units of angles and lengths.

`armlab.content.words` tells the forms.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from armlab.content.po import Message
from armlab.content.stand_ins import CHOSEN_UNIT, HELD, NAME, as_in, without_units

_NEXT_SENTENCE = re.compile(r"[.!?] +[A-Z]")


class Caught(NamedTuple):
    """A text that a message with names fits.

    Attributes
    ----------
    says : str
        The translation of the message, in the units of the text.
    inside : mapping of str to str
        What stands in the text for each name, and for the numbers of the message: as ``n0``, ``n1`` and so on.
    """

    says: str
    inside: Mapping[str, str]

    @property
    def goes_on(self) -> bool:
        """Whether what stands for something typed seems to hold the sentences behind the message as well."""
        return any(_NEXT_SENTENCE.search(text) for name, text in self.inside.items() if name.startswith("typed"))


class NamedMessage(NamedTuple):
    """A message with names.

    Attributes
    ----------
    source, text : str
    fits : pattern
        What it fits.
    in_any_units : pattern or None
        The same for a text without its units; None where the message has none.
    """

    source: str
    text: str
    fits: re.Pattern[str]
    in_any_units: re.Pattern[str] | None

    @classmethod
    def of(cls, message: Message) -> NamedMessage:
        """Return a message with what it fits."""
        unitless, units = without_units(message.source)
        return cls(message.source, message.text, _pattern(message.source), _pattern(unitless) if units else None)

    @property
    def words(self) -> int:
        """How much of a text it says itself, in characters."""
        return len(NAME.sub("", self.source))

    def caught(self, text: str) -> Caught | None:
        """Return what it catches of a text whose numbers are counted from 0; None where it does not fit."""
        match = self.fits.fullmatch(text)
        if match is not None:
            return Caught(self.text, match.groupdict())
        if self.in_any_units is None:
            return None
        unitless, units = without_units(text)
        match = self.in_any_units.fullmatch(unitless) if units else None
        return None if match is None else self._in_units(match, units)

    def _in_units(self, match: re.Match[str], units: tuple[str, ...]) -> Caught | None:
        """Return what is caught of a text without units, with these units in their places."""
        places = [found.start() for found in CHOSEN_UNIT.finditer(match.string)]
        spans = {name: match.span(name) for name in match.groupdict()}
        inside = {
            name: with_units(match[name], [unit for unit, at in zip(units, places, strict=True) if first <= at < end])
            for name, (first, end) in spans.items()
        }
        own = [
            unit
            for unit, at in zip(units, places, strict=True)
            if not any(first <= at < end for first, end in spans.values())
        ]
        says = in_units(self.text, self.source, own)
        return None if says is None else Caught(says, inside)


def in_units(says: str, source: str, units: list[str] | tuple[str, ...]) -> str | None:
    """Return the translation of a source with other units; None if it has its units in another order.

    >>> in_units("a {0} mm, {1}°", "{0} mm away, {1}°", ["m", " rad"])
    'a {0} m, {1} rad'
    """
    unitless, of = without_units(says)
    # In another order nobody knows which is which.
    return with_units(unitless, units) if of == without_units(source)[1] else None


def with_units(text: str, units: list[str] | tuple[str, ...]) -> str:
    """Return a text with units in place of their signs."""
    own = iter(units)
    return CHOSEN_UNIT.sub(lambda _: next(own), text)


def own_numbers(caught: Caught, back: dict[str, str]) -> str:
    """Return the translation with the numbers that were caught; see `armlab.content.stand_ins.renumbered`."""

    def own(held: re.Match[str]) -> str:
        number = caught.inside.get(f"n{held[1]}")
        return as_in(held[0] if number is None else number, back)

    return HELD.sub(own, caught.says)


def _pattern(source: str) -> re.Pattern[str]:
    """Return what fits the source of a message with names; its own numbers are caught as ``n0``, ``n1`` and so on."""
    made, seen = [], set[str]()
    for piece in re.split(r"(\{[a-z_]+\}|\{\d+\})", source):
        name = piece[1:-1] if piece.startswith("{") else ""
        if not name:
            made.append(re.escape(piece))
        elif name in seen:
            made.append(f"(?P=n{name})" if name.isdigit() else f"(?P={name})")
        else:
            seen.add(name)
            made.append(rf"(?P<n{name}>\{{\d+\}})" if name.isdigit() else f"(?P<{name}>.+?)")
    return re.compile("".join(made), re.DOTALL)
