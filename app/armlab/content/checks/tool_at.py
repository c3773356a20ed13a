"""The tool is at a point of the world, perhaps with a given angle about z."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import (
    PLAIN,
    CheckType,
    Goal,
    Words,
    angle_tolerance,
    length_tolerance,
    turn_between,
    with_edge,
)
from armlab.content.checks._branches import other_elbow
from armlab.content.checks._position import point, position_mistake, refuse_out_of_reach
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True, eq=False)
class ToolAt:
    """Position within a tolerance, in metres of the world; ``phi`` in rad is the direction of the tool's x axis.

    A ``marked`` position is shown in the scene.
    """

    position: NDArray[np.float64]
    within: float
    phi: float | None = None
    phi_within: float = math.radians(1.0)
    marked: bool = False

    @property
    def goals(self) -> tuple[Goal, ...]:
        """The ball in which the tool has to be, if it is to be marked."""
        return (Goal(self.position, self.within),) if self.marked else ()

    def is_met(self, observation: Observation) -> bool:
        """Return whether position and angle are within their tolerances."""
        turned = self._turn_missing(observation)
        return self._is_there(observation) and self._is_turned(turned)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the distance of the tool and the wrong coordinate, or on its angle."""
        distance, turned = self._distance(observation), self._turn_missing(observation)
        if not self._is_there(observation):
            mistake = position_mistake(observation.tool_pose[:3, 3], self.position, self.within, words)
            return f"The tool is {words.length(distance)} away from {point(self.position, words)}: {mistake}."
        if turned is None or self._is_turned(turned):
            return "The tool is where it should be."
        way = "counter-clockwise" if turned > 0 else "clockwise"
        says = f"The position is right; the angle φ is not: rotate the tool {words.angle(abs(turned))} {way}."
        other = other_elbow(observation.arm, observation.q)
        if other is not None and self.is_met(Observation.of(observation.arm, other)):
            says += " The arm stands in the mirror branch: bend the elbow the other way."
        return says

    def _is_there(self, observation: Observation) -> bool:
        return self._distance(observation) <= with_edge(self.within)

    def _is_turned(self, missing: float | None) -> bool:
        return missing is None or abs(missing) <= with_edge(self.phi_within)

    def _distance(self, observation: Observation) -> float:
        return float(np.linalg.norm(observation.tool_pose[:3, 3] - self.position))

    def _turn_missing(self, observation: Observation) -> float | None:
        if self.phi is None:
            return None
        x = observation.tool_pose[:2, 0]
        return turn_between(math.atan2(x[1], x[0]), self.phi)


def read(table: Table, robot: Robot) -> ToolAt:
    """Read ``position`` and ``tolerance_m`` in metres; ``phi_deg``, ``tolerance_deg`` (1) in degrees; ``marked``."""
    position = table.numbers("position", 3)
    phi = math.radians(table.number("phi_deg")) if table.has("phi_deg") else None
    within = length_tolerance(table, robot)
    if table.has("tolerance_deg") and phi is None:
        raise table.fail("tolerance_deg", "expected phi_deg with it")
    refuse_out_of_reach(table, "position", position, robot, within)
    return ToolAt(position, within, phi, angle_tolerance(table, 1.0), table.boolean("marked", False))


CHECK = CheckType("tool_at", 10, read)
