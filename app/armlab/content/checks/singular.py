"""The arm is singular, or it is not, as asked."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._singular import read_sigma, singular_values
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class Singular:
    """Whether the smallest dimensionless singular value of the task Jacobian is below ``sigma``, as ``want`` says."""

    want: bool
    sigma: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether the arm is singular, or not singular, as asked."""
        return (self._smallest(observation) < self.sigma) == self.want

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the smallest singular value and its required range."""
        now = self._smallest(observation)
        if (now < self.sigma) == self.want:
            return "The arm is singular here." if self.want else "The arm is not singular here."
        if self.want:
            return (
                f"The arm is not singular here: the smallest singular value is {now:.3f} and should be below "
                f"{self.sigma:g} (lengths in units of half the reach)."
            )
        return (
            f"The arm is singular here: the smallest singular value is {now:.3f} and should be at least "
            f"{self.sigma:g} (lengths in units of half the reach)."
        )

    def _smallest(self, observation: Observation) -> float:
        return float(singular_values(observation.arm, observation.q)[-1])


def read(table: Table, robot: Robot) -> Singular:
    """Read ``want`` (default true) and ``sigma`` (0.02)."""
    return Singular(table.boolean("want", True), read_sigma(table))


CHECK = CheckType("singular", 40, read)
