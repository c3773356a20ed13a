"""An acceleration that is plus or minus one on given intervals: whether these say, at each time, which of both."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from armlab.errors import InputError

Interval = tuple[float, float]
Intervals = Sequence[Interval]

ON_8 = (((0.0, 1.0), (3.0, 4.0), (5.0, 7.0)), ((1.0, 3.0), (4.0, 5.0), (7.0, 8.0)))
"""Intervals of +1 and of -1 in the example of 1.40-1.42, corrected: they fill 0 to 8."""

ON_8_PRINTED = (((0.0, 1.0), (0.375, 4.0), (0.625, 0.875)), ((1.0, 0.375), (4.0, 0.625), (0.875, 8.0)))
"""Intervals as 1.41 prints them, with 3/8, 5/8 and 7/8 for 3, 5 and 7: two end before they begin, and are empty."""


class Piece(NamedTuple):
    """A stretch of time with the signs that hold on all of it.

    Attributes
    ----------
    start, end : float
        Seconds.
    plus, minus : bool
        Whether an interval of +1, or of -1, has it inside.
    """

    start: float
    end: float
    plus: bool
    minus: bool

    @property
    def sign(self) -> int:
        """The acceleration, +1 or -1; 0 where none or both are said."""
        return int(self.plus) - int(self.minus)

    @property
    def determined(self) -> bool:
        """Whether exactly one of both holds."""
        return self.plus != self.minus


def pieces(plus: Intervals, minus: Intervals, duration: float) -> list[Piece]:
    """Return the stretches of the time from 0 to the duration, as long as the same signs hold.

    Intervals that end before they begin are empty; what lies outside is left out.

    Raises
    ------
    InputError
        The duration is not above zero.

    References
    ----------
    Notes 1.41.
    """
    if not duration > 0.0:
        raise InputError(f"duration: expected more than 0 s, got {duration:g} s")
    ends = {end for one in (*plus, *minus) for end in one if 0.0 < end < duration}
    found = list[Piece]()
    for start, end in pairwise(sorted({0.0, duration, *ends})):
        middle = 0.5 * (start + end)
        inside = [any(low < middle < high for low, high in some) for some in (plus, minus)]
        if found and [found[-1].plus, found[-1].minus] == inside:
            start = found.pop().start
        found.append(Piece(start, end, *inside))
    return found


def undetermined_share(found: Sequence[Piece]) -> float:
    """Return the share of the time at which both signs hold, or none: 0 for intervals that define an acceleration.

    >>> undetermined_share(pieces(*ON_8_PRINTED, 8.0)), undetermined_share(pieces(*ON_8, 8.0))
    (0.390625, 0.0)
    """
    lost = sum(one.end - one.start for one in found if not one.determined)
    return lost / (found[-1].end - found[0].start)


def ends_of(found: Sequence[Piece]) -> tuple[float, float]:
    """Return speed and place at the end, from rest at 0, of the acceleration of pieces (notes 1.42).

    Where it is not determined, it is taken as 0.

    >>> ends_of(pieces(*ON_8, 8.0))
    (0.0, 0.0)
    """
    speed = place = 0.0
    for one in found:
        time = one.end - one.start
        place += speed * time + 0.5 * one.sign * time**2
        speed += one.sign * time
    return speed, place
