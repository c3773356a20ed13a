"""When and how often work on an assignment was handed in, as its file claims."""

from __future__ import annotations

import math
from dataclasses import dataclass

from armlab.content.assignment import Assignment, said_date
from armlab.content.names import named
from armlab.errors import InputError
from armlab.session.state import Json
from armlab.teaching.assignment_work import Work

GRACE = 1.0
"""Time by which a file may be beyond a date, seconds, since the times in it are rounded."""

MOST_TIMES = 1_000_000
"""Largest number of attempts that is believed, and of times that an assignment was left."""


@dataclass(frozen=True)
class Handed:
    """The times that the file of an assignment claims; no file proves them.

    Attributes
    ----------
    of : Assignment
    begun, handed : float
        Seconds since 1970.
    attempt : int
        Number of the attempt, from 1.
    left : int
        How often the assignment was left.
    by_clock : bool
        Whether it was handed in because the time was over.
    """

    of: Assignment
    begun: float
    handed: float
    attempt: int
    left: int
    by_clock: bool

    @property
    def late(self) -> float:
        """Seconds by which it came late; 0 for in time."""
        return 0.0 if self.of.due is None else max(0.0, self.handed - self.of.due - GRACE)

    @property
    def part_left(self) -> float:
        """Part of the points that is left to late work; 1 for in time."""
        return 1.0 - self.of.late_percent / 100.0 if self.late else 1.0

    @property
    def problem(self) -> str:
        """Why the work does not count; empty when it does."""
        ends = self.of.ends(self.begun)
        if self.of.opens is not None and self.begun < self.of.opens - GRACE:
            return f"It was begun before the assignment opened on {said_date(self.of.opens)}."
        if ends is not None and self.handed > ends + GRACE:
            return f"It was handed in on {said_date(self.handed)}, after its time was over on {said_date(ends)}."
        if self.of.attempts and self.attempt > self.of.attempts:
            return f"This is attempt {self.attempt}; {self.of.attempts} can be handed in."
        return ""

    @property
    def remark(self) -> str:
        """Remark for the teacher on the times."""
        late = f"Late by {_span(self.late)}." if self.late else ""
        times = f"{self.left} times" if self.left > 1 else "once"
        left = f"Left {times} before it was handed in." if self.left else ""
        return " ".join(filter(None, (late, left)))


def of_assignment(assigned: Assignment, work: Work) -> dict[str, Json]:
    """Return what the file says of the work on an assignment as a whole.

    Raises
    ------
    InputError
        It has not been handed in.
    """
    if work.handed is None:
        raise InputError("This work has not been handed in yet.")
    return {
        "assignment": named(assigned.key),
        "version": assigned.version,
        "digest": assigned.digest,
        "variant": work.number,
        "begun": round(work.begun, 1),
        "handed_in": round(work.handed, 1),
        "attempt": work.attempts,
        "left": work.left,
        "by_clock": work.by_clock,
    }


def handed_of(assigned: Assignment, data: Json) -> Handed:
    """Return the times that a file claims.

    Raises
    ------
    InputError
        They cannot be.
    """
    try:
        begun, handed = float(data["begun"]), float(data["handed_in"])
        attempt, left = int(data["attempt"]), int(data["left"])
    except (KeyError, TypeError, ValueError, OverflowError):
        raise InputError("the times in this file are damaged") from None
    # A year beyond 9999 has no date.
    times = 0.0 <= begun <= handed < 2.5e11
    if not (times and 1 <= attempt <= MOST_TIMES and 0 <= left <= MOST_TIMES):
        raise InputError("the times in this file are damaged")
    return Handed(assigned, begun, handed, attempt, left, data.get("by_clock") is True)


def _span(seconds: float) -> str:
    """Return a time span in its largest fitting unit.

    >>> _span(30), _span(5400), _span(200_000)
    ('1 min', '1 h 30 min', '2 d 7 h')
    """
    minutes = math.ceil(seconds / 60.0)
    if minutes < 60:
        return f"{minutes} min"
    hours, rest = divmod(minutes, 60)
    if hours < 24:
        return f"{hours} h {rest} min"
    return f"{hours // 24} d {hours % 24} h"
