"""Commands of the intervals of plus and minus one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.signs import DURATION, Signs, percent, read
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import Entry, Timing
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.kin.motion.signs import ON_8, ON_8_PRINTED
from armlab.registry import known_name
from armlab.session.fields import setting
from armlab.session.state import Command, State

SIDES = {"plus": "s̈ = +1 on", "minus": "s̈ = −1 on"}

READINGS = {"whole": ON_8, "eighths": ON_8_PRINTED}
"""The example with 3, 5 and 7, and as it is printed, with 3/8, 5/8 and 7/8."""


@dataclass(frozen=True)
class SetSigns(Command):
    """Say on which intervals the acceleration is plus, or minus, one.

    Parameters
    ----------
    side : "plus" or "minus"
    intervals : str
        Such as ``0-1, 3/8-4``.
    """

    side: str
    intervals: str
    label: ClassVar[str] = "intervals of the signs"

    def apply(self, state: State) -> State:
        """Return the state with these intervals."""
        known_name("sign", self.side, SIDES)
        some = read(self.intervals, SIDES[self.side])
        signs = state[Laws].signs
        return _with(state, replace(signs, plus=some) if self.side == "plus" else replace(signs, minus=some))


@dataclass(frozen=True)
class ReadSigns(Command):
    """Take the intervals of the example with whole seconds, ``whole``, or with ``eighths`` as printed."""

    reading: str
    label: ClassVar[str] = "intervals of the signs"

    def apply(self, state: State) -> State:
        """Return the state with these intervals."""
        known_name("reading", self.reading, READINGS)
        plus, minus = READINGS[self.reading]
        return _with(state, Signs(plus, minus, DURATION))


@dataclass(frozen=True)
class UseSigns(Command):
    """Make a law of the intervals and show it alone, if they determine one."""

    label: ClassVar[str] = "law from intervals"

    def apply(self, state: State) -> State:
        """Return the state with the law; `InputError` for intervals that determine none."""
        signs = state[Laws].signs
        if signs.undetermined:
            raise InputError(
                f"intervals: at {percent(signs.undetermined)} of the time both signs hold or none, so there is no "
                "acceleration"
            )
        table = Chosen.of(free_law_types(), "table", rows=signs.rows())
        timing = Timing(duration=signs.duration, speed=None, acceleration=None, jerk=None)
        return setting(state, Laws, {"entries": (Entry(table, True),), "timing": timing, "scaled": 0, "k": 1.0})


def _with(state: State, signs: Signs) -> State:
    return setting(state, Laws, {"signs": signs})
