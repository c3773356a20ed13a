"""The task Jacobian has a given rank."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._singular import read_sigma, singular_values
from armlab.content.observation import Observation
from armlab.content.reader import Table, shown
from armlab.content.robots import Robot


@dataclass(frozen=True)
class Rank:
    """Number of dimensionless singular values of the task Jacobian that are at least ``sigma``."""

    value: int
    sigma: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether the rank is the required one."""
        return self._of(observation) == self.value

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the rank and the singular value that decides."""
        now, values = self._of(observation), singular_values(observation.arm, observation.q)
        if now == self.value:
            return f"The rank is {now}."
        says = f"The rank of the task Jacobian is {now} and should be {self.value}"
        if self.value >= len(values) or now < self.value:
            return f"{says}."
        count = now - self.value
        what = "one more singular value" if count == 1 else f"{count} more singular values"
        return (
            f"{says}: {what} must become zero; the smallest is {values[-1]:.3f}, below {self.sigma:g} counts as zero."
        )

    def _of(self, observation: Observation) -> int:
        return int(np.sum(singular_values(observation.arm, observation.q) >= self.sigma))


def read(table: Table, robot: Robot) -> Rank:
    """Read ``value`` and ``sigma`` (0.02), the limit below which a singular value counts as zero."""
    value, most = table.value("value"), min(robot.arm.task.m, robot.arm.n)
    if type(value) not in (int, float) or value not in range(most + 1):
        raise table.fail("value", f"expected a whole number from 0 to {most}, got {shown(value)}")
    return Rank(int(value), read_sigma(table))


CHECK = CheckType("rank", 45, read)
