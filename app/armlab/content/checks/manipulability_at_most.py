"""The manipulability is small enough."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words, tolerance
from armlab.content.checks._compared import compared
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class ManipulabilityAtMost:
    """The largest manipulability of the arm's task (its unit depends on the arm)."""

    value: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether the manipulability is at most this value."""
        return self._of(observation) <= self.value

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence with actual and required value."""
        now = self._of(observation)
        if now <= self.value:
            return "The manipulability is small enough."
        written, asked = compared(now, self.value)
        return f"The manipulability is {written} and should be at most {asked}."

    def _of(self, observation: Observation) -> float:
        return float(observation.arm.manipulability(observation.q))


def read(table: Table, robot: Robot) -> ManipulabilityAtMost:
    """Read ``value``."""
    return ManipulabilityAtMost(tolerance(table, "value"))


CHECK = CheckType("manipulability_at_most", 35, read)
