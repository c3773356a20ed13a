"""An acceleration that is said by intervals of +1 and of -1, as 1.41 says one, and whether they say one at all."""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Self

from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.kin.motion.signs import ON_8, Interval, Piece, ends_of, pieces, undetermined_share
from armlab.session.amounts import amount
from armlab.session.state import Json

LONGEST = 100.0
"""Largest duration, seconds."""

MOST = 12
"""Largest number of intervals of one sign."""

DURATION = 8.0

LARGEST_DENOMINATOR = 99
"""Largest denominator of a fraction that is written as one."""

Some = tuple[Interval, ...]


@dataclass(frozen=True)
class Signs:
    """Intervals of +1 and of -1.

    Attributes
    ----------
    plus, minus : tuple of (float, float)
        Seconds; one that ends before it begins is empty.
    duration : float
        Seconds.
    """

    plus: Some = ON_8[0]
    minus: Some = ON_8[1]
    duration: float = DURATION

    @classmethod
    def from_json(cls, data: Json) -> Self:
        """Return them from JSON; `InputError` when they are too many, or no finite numbers."""
        duration = float(data["duration"])
        if not 0.0 < duration <= LONGEST:
            raise InputError(f"duration: expected above 0 s and at most {LONGEST:g} s, got {duration:g} s")
        return cls(checked(data["plus"]), checked(data["minus"]), duration)

    def to_json(self) -> Json:
        """Return them as JSON."""
        data = asdict(self)
        return {**data, "plus": [list(one) for one in self.plus], "minus": [list(one) for one in self.minus]}

    @cached_property
    def pieces(self) -> list[Piece]:
        """The stretches of time, with the signs that hold on each."""
        return pieces(self.plus, self.minus, self.duration)

    @property
    def undetermined(self) -> float:
        """The share of the time at which both signs hold, or none."""
        return undetermined_share(self.pieces)

    @property
    def ends(self) -> tuple[float, float] | None:
        """Speed and place at the end, from rest at 0; None where the acceleration is not determined throughout."""
        return None if self.undetermined else ends_of(self.pieces)

    def rows(self) -> list[list[float]]:
        """Return rows (from, to, acceleration) of a law, for intervals that determine one."""
        return [[one.start, one.end, float(one.sign)] for one in self.pieces]


def checked(data: Any) -> Some:
    """Return intervals as pairs of finite numbers; `InputError` for others, or for too many."""
    try:
        found = tuple((float(start), float(end)) for start, end in data)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"intervals: expected pairs of numbers, got {str(data)[:40]!r}") from None
    if len(found) > MOST or not all(abs(end) <= LONGEST for one in found for end in one):
        raise InputError(f"intervals: expected at most {MOST}, with ends up to {LONGEST:g} s")
    return found


def read(text: str, where: str) -> Some:
    """Return intervals from a typed text such as ``0-1, 3/8-4``.

    Raises
    ------
    InputError
        Not a list of intervals; the text names what was expected.

    Examples
    --------
    >>> read("0 - 1, 3/8-4", "+1")
    ((0.0, 1.0), (0.375, 4.0))
    """
    found = []
    for part in filter(None, (each.strip() for each in re.split(r"[,;∪]", text))):
        ends = re.split(r"\s*[-–−]\s*|\s+", part.strip("[]() "))
        if len(ends) != 2:
            raise InputError(f"{where}: expected intervals such as 0-1, 3-4, got {part[:40]!r}")
        try:
            found.append((evaluate(ends[0]), evaluate(ends[1])))
        except InputError:
            raise InputError(f"{where}: expected intervals such as 0-1, 3/8-4, got {part[:40]!r}") from None
    return checked(found)


def written(some: Some) -> str:
    """Return intervals as they are typed, eighths and what has no short decimals as fractions.

    >>> written(((0.0, 1.0), (0.375, 1.55), (1.55, 25.0 / 9.0)))
    '0–1, 3/8–1.55, 1.55–25/9'
    """
    return ", ".join("–".join(map(_number, one)) for one in some)


def _number(value: float) -> str:
    eighths, fraction = (Fraction(value).limit_denominator(most) for most in (8, LARGEST_DENOMINATOR))
    if float(eighths) == value:
        return str(eighths)
    short = f"{value:g}"
    if float(short) == value:
        return short
    return str(fraction) if float(fraction) == value else repr(value)


def percent(share: float) -> str:
    """Return a share as percentage, however small.

    >>> percent(0.390625), percent(0.0), percent(1.25e-5)
    ('39.06 %', '0 %', '0.00125 %')
    """
    return f"{amount(100.0 * share)} %"
