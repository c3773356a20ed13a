"""The handle of the target has a position, and perhaps an orientation."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._pose import PoseGoal, read_goal
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True, eq=False)
class TargetAt:
    """The pose of the target in the world; the arm need not have reached it."""

    goal: PoseGoal

    def is_met(self, observation: Observation) -> bool:
        """Return whether there is a target within the tolerances."""
        return observation.target is not None and self.goal.is_met(observation.target)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on what deviates."""
        if observation.target is None:
            return "There is no target yet: drag the handle."
        return self.goal.says("The target", observation.target, words)


def read(table: Table, robot: Robot) -> TargetAt:
    """Read ``position``, ``tolerance_m``; optionally ``rpy_deg`` or ``rotation`` with ``tolerance_deg``."""
    return TargetAt(read_goal(table, robot, turned=False))


CHECK = CheckType("target_at", 15, read)
