"""An arm that differs a little from its table, and goes to the same place again and again."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

from armlab.kin.arm import Arm
from armlab.session.fields import FieldPart, choice, flag, number, put, text, whole
from armlab.session.state import Command, PartType, State

PLANES = {"xy": "x, y", "xz": "x, z", "yz": "y, z"}
"""Planes on which the positions are looked at."""

ABOUT = {"goal": "the goal", "middle": "their mean"}
"""Points in the middle of the picture, key to words."""

LARGEST_TURN, LARGEST_SLIDE, LARGEST_LENGTH = math.radians(5.0), 0.05, 0.05
"""Largest error of a joint that turns, rad, and that slides, m, and of a length, as a fraction."""

MOST = 200
"""Largest number of visits."""


@dataclass(frozen=True)
class TaughtGoal(FieldPart):
    """How the arm differs from its table, and what is asked of it.

    Attributes
    ----------
    longer : float
        By what fraction all its lengths are larger than in the table.
    offset, slide_offset : float
        Error of the zero of each joint, rad and m.
    scatter, slide_scatter : float
        Standard deviation of where a joint stops, rad and m, other for each visit.
    visits : int
        How often it goes there.
    taught : bool
        Whether the goal is where the arm itself stood once, and not where the table says.
    clearance : float
        By how much the hole is wider than the peg, on each side, m.
    yields : float
        By how much the hand gives way sideways, m.
    seed : int
        Of the visits.
    plane, about : str
        What is seen of the positions.
    example : str
    """

    key: ClassVar[str] = "taught_goal"
    looks: ClassVar[tuple[str, ...]] = ("plane", "about")
    leave_example: ClassVar[tuple[str, ...]] = ("example", "seed", "visits")

    longer: float = number("", "lengths longer by", 5e-4, -LARGEST_LENGTH, LARGEST_LENGTH)
    offset: float = number("", "zero of turning joints", math.radians(0.1), -LARGEST_TURN, LARGEST_TURN, "rad")
    slide_offset: float = number("", "zero of sliding joints", 5e-4, -LARGEST_SLIDE, LARGEST_SLIDE, "m")
    scatter: float = number("", "scatter of turning joints", math.radians(0.003), 0.0, LARGEST_TURN, "rad")
    slide_scatter: float = number("", "scatter of sliding joints", 2e-5, 0.0, LARGEST_SLIDE, "m")
    visits: int = whole("number of visits", 30, 2, MOST)
    taught: bool = flag("the goal was taught", False)
    clearance: float = number("", "clearance of the hole", 1e-4, 0.0, 0.1, "m")
    yields: float = number("", "compliance of the hand", 0.0, 0.0, 0.1, "m")
    seed: int = whole("seed of the visits", 1, 0, 10**6)
    plane: str = choice("plane that is seen", "xy", PLANES)
    about: str = choice("middle of the picture", "goal", ABOUT)
    example: str = text("example", "repeats")

    def real(self, arm: Arm) -> Arm:
        """Return the arm as it is: with longer lengths than those of the table."""
        return _longer(arm, 1.0 + self.longer)


@lru_cache(maxsize=8)
def _longer(arm: Arm, factor: float) -> Arm:
    return replace(arm, rows=tuple(replace(row, a=factor * row.a, d=factor * row.d) for row in arm.rows))


PART = PartType(TaughtGoal, order=43)


@dataclass(frozen=True)
class VisitAgain(Command):
    """Let the arm go there as often once more, with other errors by chance."""

    label: ClassVar[str] = "visits"

    def apply(self, state: State) -> State:
        """Return the state with the next seed."""
        part = state[TaughtGoal]
        return put(state, replace(part, seed=part.seed + 1 if part.seed < 10**6 else 0))
