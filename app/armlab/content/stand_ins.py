"""Stand-ins in a text that is looked up: for its numbers, its elements, the units of the reader, and any text.

`armlab.content.words` tells the forms.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

NUMBER = re.compile(
    r"(?<![\w.{<⟨])[-−+±]?\d+(?:[.\u202f,]\d+)*(?:e[-−+]?\d+)?(?![A-Za-z\d])(?:·10(?=[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]))?(?:⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?"
)
"""A number that stands by itself, with its power of ten: none in UR5 or q₁."""

HELD = re.compile(r"\{(\d+)\}|<(/?)(\d+)(/?)>")
"""A stand-in of a number or an element."""

NAME = re.compile(r"\{([a-z_]+)\}")
"""A stand-in of any text."""

_CHOSEN = re.compile(r"(?P<angle>(?<=\})(?: rad\b| ?°)|\brad\b|°)|(?<![\w<{])mm?(?![A-Za-z\d₀-₉>])")
UNIT_SIGNS = _ANGLE, _LENGTH = "\ue000", "\ue001"
"""Signs in place of units, of private use, which no text of the lab has."""

CHOSEN_UNIT = re.compile(f"[{_ANGLE}{_LENGTH}]")
"""A sign in place of a unit that a person chooses."""

MOST_KEPT = 20_000
"""Largest number of texts that are kept in a form that takes time to find."""


class Plain(NamedTuple):
    """A text without its numbers, and these."""

    text: str
    numbers: tuple[str, ...]


def without_numbers(text: str) -> Plain:
    """Return a text with ``{0}``, ``{1}`` in place of its numbers.

    >>> without_numbers("2 of 8 solutions")
    Plain(text='{0} of {1} solutions', numbers=('2', '8'))
    """
    numbers: list[str] = []

    def held(found: re.Match[str]) -> str:
        numbers.append(found[0])
        return f"{{{len(numbers) - 1}}}"

    return Plain(NUMBER.sub(held, text), tuple(numbers))


@lru_cache(MOST_KEPT)
def without_units(text: str) -> tuple[str, tuple[str, ...]]:
    """Return a text with signs in place of units of angles and lengths, which a person chooses, and these.

    A text that has such signs itself, as what people write may, stays as it is: nobody could tell them apart.

    >>> without_units("{0} mm and {1}° away")[1], without_units("{0} m and {1} rad away")[1]
    (('mm', '°'), ('m', ' rad'))
    >>> without_units("{0} mm and {1}° away")[0] == without_units("{0} m and {1} rad away")[0]
    True
    """
    if CHOSEN_UNIT.search(text):
        return text, ()
    units: list[str] = []

    def held(found: re.Match[str]) -> str:
        units.append(found[0])
        return _ANGLE if found["angle"] else _LENGTH

    return _CHOSEN.sub(held, text), tuple(units)


def with_numbers(text: str, numbers: tuple[str, ...]) -> str:
    """Return a text with its numbers in place of ``{0}``, ``{1}``."""
    return HELD.sub(lambda held: numbers[int(held[1])] if held[1] else held[0], text)


def renumbered(text: str) -> tuple[str, dict[str, str]]:
    """Return a text whose numbers and elements are counted from 0, and what each of them was.

    >>> renumbered("to {3} of <2>all</2>")
    ('to {0} of <0>all</0>', {'{0}': '{3}', '<0': '<2'})
    """
    numbers: dict[str, str] = {}
    elements: dict[str, str] = {}

    def held(found: re.Match[str]) -> str:
        if found[1] is not None:
            return f"{{{numbers.setdefault(found[1], str(len(numbers)))}}}"
        return f"<{found[2]}{elements.setdefault(found[3], str(len(elements)))}{found[4]}>"

    text = HELD.sub(held, text)
    back = {f"{{{now}}}": f"{{{was}}}" for was, now in numbers.items()}
    return text, back | {f"<{now}": f"<{was}" for was, now in elements.items()}


def as_in(text: str, back: dict[str, str]) -> str:
    """Return a text with the numbers of where it belongs; see `renumbered`."""

    def held(found: re.Match[str]) -> str:
        if found[1] is not None:
            return back.get(found[0], found[0])
        return f"<{found[2]}{back.get(f'<{found[3]}', found[3]).removeprefix('<')}{found[4]}>"

    return HELD.sub(held, text) if back else text


def placeholders(text: str) -> list[str]:
    """Return what stands for something else in a message, sorted."""
    return sorted([found[0] for found in HELD.finditer(text)] + [found[0] for found in NAME.finditer(text)])
