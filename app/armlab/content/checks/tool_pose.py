"""The tool has a given position and orientation."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._pose import PoseGoal, read_goal
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True, eq=False)
class ToolPose:
    """The pose of the tool in the world."""

    goal: PoseGoal

    def is_met(self, observation: Observation) -> bool:
        """Return whether position and orientation are within their tolerances."""
        return self.goal.is_met(observation.tool_pose)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the deviation of position or orientation, and a recognised mistake."""
        return self.goal.says("The tool", observation.tool_pose, words)


def read(table: Table, robot: Robot) -> ToolPose:
    """Read ``position``, ``tolerance_m``, ``rpy_deg`` or ``rotation``, and ``tolerance_deg``."""
    return ToolPose(read_goal(table, robot, turned=True))


CHECK = CheckType("tool_pose", 12, read)
