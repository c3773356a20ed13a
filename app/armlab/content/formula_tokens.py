"""The words of a formula: numbers, names, functions, units and signs."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from armlab.content.symbols import plain_symbols
from armlab.errors import InputError, suggestion

LONGEST_TOGETHER = 60
"""Longest run of names without separator, in characters, such as ``l1c12``."""

PATTERN = re.compile(
    r"\s*(?:(?P<number>\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*)|(?P<sign>\*\*|[-+*/^(),°]))"
)


@dataclass(frozen=True)
class Token:
    """A token; ``kind`` is number, name, function, sign or end."""

    kind: str
    text: str = ""


END = Token("end")

UNITS = {"deg": "°", "rad": "rad"}
"""Units of angles behind a factor, as signs; before a bracket they are functions."""


class Known:
    """The known names and functions, and the division of an identifier into them."""

    def __init__(self, names: Collection[str], functions: Collection[str], joined: bool) -> None:
        self.names = {plain_symbols(name): name for name in names}
        self.functions = functions
        self._pieces = sorted({*self.names, "pi"}, key=len, reverse=True) if joined else []

    def tokens(self, word: str, before_bracket: bool) -> list[Token]:
        """Return the meaning of an identifier: a name, a function, or a product of names without separator."""
        for spelling in (word, word.replace("_", "")):
            if spelling in self.names:
                return [Token("name", self.names[spelling])]
        lowered = word.lower()
        if lowered in UNITS and not before_bracket:
            return [Token("sign", UNITS[lowered])]
        if lowered in self.functions:
            return [Token("function", lowered)]
        if lowered == "pi":
            return [Token("name", "pi")]
        together = self._together(word, before_bracket) or self._together(word.replace("_", ""), before_bracket)
        if together is None:
            raise InputError(f"unknown name {word!r}{suggestion(word, {*self.names.values(), *self.functions, 'pi'})}")
        return together

    def _together(self, word: str, before_bracket: bool) -> list[Token] | None:
        """Return the names, longest first, that form a word, with a function at its end before a bracket; else None."""
        if len(word) > LONGEST_TOGETHER:
            return None
        made: dict[int, list[Token]] = {len(word): []}  # from each place to the end
        for start in range(len(word) - 1, -1, -1):
            if before_bracket and word[start:] in self.functions:
                made[start] = [Token("function", word[start:])]
                continue
            for piece in self._pieces:
                if word.startswith(piece, start) and start + len(piece) in made:
                    made[start] = [Token("name", self.names.get(piece, piece)), *made[start + len(piece)]]
                    break
        return made.get(0)


def tokens_of(source: str, known: Known) -> list[Token]:
    """Return the tokens of a formula; ``InputError`` for a sign or name that is none."""
    tokens: list[Token] = []
    position = 0
    while position < len(source):
        found = PATTERN.match(source, position)
        if found is None:
            raise InputError(f"expected numbers, names, + - * / ^ and brackets, got {source[position:].strip()[:12]!r}")
        position = found.end()
        if found["number"]:
            tokens.append(Token("number", found["number"]))
        elif found["name"]:
            tokens += known.tokens(found["name"], source[position:].lstrip().startswith("("))
        else:
            tokens.append(Token("sign", found["sign"].replace("**", "^")))
    return tokens
