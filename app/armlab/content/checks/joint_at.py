"""One joint has a value."""

from __future__ import annotations

import math
from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words, angle_tolerance, length_tolerance, turn_between, with_edge
from armlab.content.checks._joint import joint_mistake
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class JointAt:
    """Joint ``number`` (from 1) is at ``value`` within a tolerance, in rad up to whole turns, or in m."""

    number: int
    value: float
    within: float
    revolute: bool

    def is_met(self, observation: Observation) -> bool:
        """Return whether the joint is within the tolerance."""
        return self.number <= len(observation.q) and abs(self._missing(observation)) <= with_edge(self.within)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence with actual and required value; it names a wrong sign, and degrees taken for radians."""
        if len(observation.q) < self.number:
            return f"The arm has no joint {self.number}."
        written = words.angle if self.revolute else words.length
        now = float(observation.q[self.number - 1])
        if self.is_met(observation):
            return f"Joint {self.number} is where it should be."
        mistake = joint_mistake(now, self.value, self.within, self.revolute)
        return f"Joint {self.number} is at {written(now)} and should be at {written(self.value)}.{mistake}"

    def _missing(self, observation: Observation) -> float:
        now = float(observation.q[self.number - 1])
        return turn_between(now, self.value) if self.revolute else self.value - now


def read(table: Table, robot: Robot) -> JointAt:
    """Read ``joint`` (from 1), ``value_deg`` or ``value_m``, and ``tolerance_deg`` or ``tolerance_m``."""
    number = table.number("joint")
    if number not in range(1, robot.arm.n + 1):
        raise table.fail("joint", f"expected a joint from 1 to {robot.arm.n}, got {number:g}")
    i = int(number) - 1
    revolute = bool(robot.arm.revolute[i])
    unit, factor = ("deg", math.pi / 180) if revolute else ("m", 1.0)
    value = table.number(f"value_{unit}") * factor
    within = angle_tolerance(table) if revolute else length_tolerance(table, robot)
    low, high = robot.arm.limits[i]
    if not low - within <= value <= high + within:
        raise table.fail(
            f"value_{unit}", f"outside the limits of joint {i + 1}: {low / factor:g} to {high / factor:g} {unit}"
        )
    return JointAt(i + 1, value, within, revolute)


CHECK = CheckType("joint_at", 20, read)
