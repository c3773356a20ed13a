"""Not more than a given time has passed since the step was shown; for use in ``all_of``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.content.check import PLAIN, CheckType, Words, tolerance
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class WithinSeconds:
    """The largest number of seconds."""

    noted: ClassVar[tuple[str, ...]] = ("the time",)

    most: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether there is time left."""
        return observation.seconds <= self.most

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the time it took, in tenths of a second on the side of the limit where it is."""
        tenths = 10.0 * observation.seconds
        if self.is_met(observation):
            return f"In time: {math.floor(tenths) / 10.0:g} s of the {self.most:g} s allowed."
        return f"It took {math.ceil(tenths) / 10.0:g} s; at most {self.most:g} s are allowed. Begin the step again."


def read(table: Table, robot: Robot) -> WithinSeconds:
    """Read ``at_most_s``."""
    return WithinSeconds(tolerance(table, "at_most_s"))


CHECK = CheckType("within_seconds", 110, read, alone=False)
