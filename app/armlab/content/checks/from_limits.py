"""Every joint keeps a distance from its limits; for use in ``all_of``."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import PLAIN, CheckType, Words, tolerance
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

ROUNDING = 1e-9
"""Distance, radians or metres, that may be missing: rounding of a joint that was set in degrees."""


@dataclass(frozen=True, eq=False)
class FromLimits:
    """Least distance of each joint from both limits, shape (n,), rad or m."""

    least: NDArray[np.float64]

    def is_met(self, observation: Observation) -> bool:
        """Return whether all joints keep their distance."""
        rooms = _rooms(observation)
        return rooms.shape == self.least.shape and bool(np.all(rooms >= self.least - ROUNDING))

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first joint that is too close, and by how much."""
        if self.is_met(observation):
            return "All joints are far enough from their limits."
        rooms = _rooms(observation)
        if rooms.shape != self.least.shape:
            return f"The arm has {len(rooms)} joints; it should have {len(self.least)}."
        j = int(np.flatnonzero(rooms < self.least - ROUNDING)[0])
        written = words.angle if observation.arm.revolute[j] else words.length
        return (
            f"Joint {j + 1} is {written(float(rooms[j]))} from its limit; at least "
            f"{written(float(self.least[j]))} are required."
        )


def _rooms(observation: Observation) -> NDArray[np.float64]:
    """Return the distance of each joint from the nearer limit; negative outside."""
    low, high = observation.arm.limits.T
    return np.asarray(np.minimum(observation.q - low, high - observation.q))


def read(table: Table, robot: Robot) -> FromLimits:
    """Read ``at_least_deg`` for revolute joints and ``at_least_m`` for prismatic ones, at least one of them."""
    arm = robot.arm
    given = [key for key, there in (("at_least_deg", arm.revolute), ("at_least_m", ~arm.revolute)) if there.any()]
    if not any(table.has(key) for key in given):
        raise table.fail(given[0], "missing; expected how far the joints are from their limits")
    turn = math.radians(tolerance(table, "at_least_deg")) if table.has("at_least_deg") else 0.0
    slide = tolerance(table, "at_least_m") if table.has("at_least_m") else 0.0
    least = np.where(arm.revolute, turn, slide)
    narrow = np.flatnonzero(np.diff(arm.limits)[:, 0] <= 2.0 * least)
    if len(narrow):
        key = "at_least_deg" if arm.revolute[narrow[0]] else "at_least_m"
        raise table.fail(key, f"joint {narrow[0] + 1} cannot be so far from both of its limits")
    return FromLimits(least)


CHECK = CheckType("from_limits", 115, read, alone=False)
