"""All joints have the values that the student has to find: like ``joints_at``, but without revealing them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._joint import joint_mistake
from armlab.content.checks.joints_at import JointsAt
from armlab.content.checks.joints_at import read as read_values
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


class JointsFound(JointsAt):
    """The configuration ``q``, shape (n,), of a step in which students compute it."""

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the mistake that explains the configuration, or which joints are right and which are wrong."""
        q = observation.q
        if self.is_met(observation) or q.shape != self.q.shape:
            return super().says(observation, words)
        if named := self._mistake(observation):
            return named
        off = np.flatnonzero(self._off(q)).tolist()
        reasons = (
            joint_mistake(float(q[i]), float(self.q[i]), float(self.within[i]), bool(self.revolute[i])) for i in off
        )
        return self._which(off) + next(filter(None, reasons), "")

    def _which(self, off: list[int]) -> str:
        right = [i for i in range(len(self.q)) if i not in off]
        if not right:
            return "No joint is where it should be yet." if len(off) > 1 else "The joint is not where it should be yet."
        return f"{_joints(right)} {_are(right)} right, {_joints(off).lower()} {_are(off)} not yet."


def _are(numbers: Sequence[int]) -> str:
    return "are" if len(numbers) > 1 else "is"


def _joints(numbers: Sequence[int]) -> str:
    *most, last = (str(i + 1) for i in numbers)
    return f"Joints {', '.join(most)} and {last}" if most else f"Joint {last}"


def read(table: Table, robot: Robot) -> JointsFound:
    """Read the fields of ``joints_at``."""
    asked = read_values(table, robot)
    return JointsFound(asked.q, asked.within, asked.revolute, asked.turns)


CHECK = CheckType("joints_found", 26, read)
