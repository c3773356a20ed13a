"""The work of a student on an assignment: when it was begun and handed in, and how often."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from armlab.content.as_written import as_part
from armlab.content.assignment import Assignment
from armlab.errors import InputError
from armlab.session.state import Json


@dataclass(frozen=True)
class Work:
    """The work on one assignment; moments are seconds since 1970.

    Attributes
    ----------
    number : int
        The variant of its lessons, where that is the student's own.
    begun : float
    handed : float or None
        When it was handed in last; None while it is worked on. It cannot be changed until it is taken up again.
    attempts : int
        How often it was handed in.
    left : int
        How often it was left before that.
    by_clock : bool
        Whether it was handed in because the time was over.
    """

    number: int
    begun: float
    handed: float | None = None
    attempts: int = 0
    left: int = 0
    by_clock: bool = False

    def over(self, of: Assignment, now: float) -> bool:
        """Return whether the time for it is over."""
        ends = of.ends(self.begun)
        return ends is not None and now >= ends

    def left_over(self, of: Assignment, now: float) -> bool:
        """Return whether it can be taken up again after it was handed in."""
        return (of.attempts == 0 or self.attempts < of.attempts) and not self.over(of, now)

    def handed_in(self, now: float, by_clock: bool = False) -> Work:
        """Return the work handed in at a moment."""
        return replace(self, handed=now, attempts=self.attempts + 1, by_clock=by_clock)

    def at(self, of: Assignment, now: float) -> Work:
        """Return the work as it is at a moment: handed in when its time is over."""
        if self.handed is not None or not self.over(of, now):
            return self
        return self.handed_in(of.ends(self.begun) or now, by_clock=True)

    def to_json(self) -> Json:
        """Return the work as JSON."""
        return {
            "number": self.number,
            "begun": self.begun,
            "handed": self.handed,
            "attempts": self.attempts,
            "left": self.left,
            "by_clock": self.by_clock,
        }

    @classmethod
    def from_json(cls, data: Json) -> Work:
        """Return the work from JSON.

        Raises
        ------
        InputError
            Numbers that cannot be.
        KeyError, TypeError, ValueError
            The data are not usable.
        """
        handed = None if data["handed"] is None else float(data["handed"])
        counts = int(data["number"]), int(data["attempts"]), int(data["left"])
        found = cls(counts[0], float(data["begun"]), handed, *counts[1:], bool(data["by_clock"]))
        if min(counts) < 0 or not all(map(math.isfinite, (found.begun, found.handed or 0.0))):
            raise InputError("assignment: expected moments and counts from 0")
        return found


def is_open(found: Assignment) -> str:
    """Return the sentence that tells that an assignment is open."""
    return f"The assignment “{as_part(found.title)}” is open."
