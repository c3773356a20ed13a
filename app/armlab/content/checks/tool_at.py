"""The tool is at a point of the world, perhaps with a given angle about z."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import PLAIN, CheckType, Words, tolerance, turn_between
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

_MIRRORED = (
    ((-1, 1), "x has the wrong sign"),
    ((1, -1), "y has the wrong sign: positive angles turn counter-clockwise"),
    ((-1, -1), "x and y both have the wrong sign: the arm points the opposite way"),
)


@dataclass(frozen=True, eq=False)
class ToolAt:
    """Position within a tolerance, in metres of the world; ``phi`` in rad is the direction of the tool's x axis."""

    position: NDArray[np.float64]
    within: float
    phi: float | None = None
    phi_within: float = math.radians(1.0)

    def is_met(self, observation: Observation) -> bool:
        """Whether position and angle are within their tolerances."""
        turned = self._turn_missing(observation)
        return self._distance(observation) <= self.within and (turned is None or abs(turned) <= self.phi_within)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return how far the tool is away and in which coordinate, or how far it is turned."""
        distance, turned = self._distance(observation), self._turn_missing(observation)
        if distance > self.within:
            mistake = self._mistake(observation.tool_pose[:3, 3], words)
            return f"The tool is {words.length(distance)} away from {_point(self.position, words)}: {mistake}."
        if turned is None or abs(turned) <= self.phi_within:
            return "The tool is where it should be."
        way = "counter-clockwise" if turned > 0 else "clockwise"
        return f"The position is right; the angle φ is not: turn the tool {words.angle(abs(turned))} {way}."

    def _distance(self, observation: Observation) -> float:
        return float(np.linalg.norm(observation.tool_pose[:3, 3] - self.position))

    def _turn_missing(self, observation: Observation) -> float | None:
        if self.phi is None:
            return None
        x = observation.tool_pose[:2, 0]
        return turn_between(math.atan2(x[1], x[0]), self.phi)

    def _mistake(self, p: NDArray[np.float64], words: Words) -> str:
        """Return the mistake that explains the position, or the coordinate that is farthest off."""
        asked = self.position
        for signs, says in _MIRRORED:
            if np.linalg.norm(p - asked * [*signs, 1]) <= self.within:
                return says
        if np.linalg.norm(p - asked[[1, 0, 2]]) <= self.within:
            return "x and y are exchanged"
        k = int(np.argmax(np.abs(p - asked)))
        return f"{'xyz'[k]} is {words.length(float(p[k]))} and should be {words.length(float(asked[k]))}"


def _point(p: NDArray[np.float64], words: Words) -> str:
    written = [words.length(float(value)) for value in p]
    unit = written[0].rpartition(" ")[2]
    return f"({', '.join(text.removesuffix(f' {unit}') for text in written)}) {unit}"


def read(table: Table, robot: Robot) -> ToolAt:
    """Read ``position`` and ``tolerance_m`` in metres; ``phi_deg`` and ``tolerance_deg`` (1) in degrees."""
    position = table.numbers("position", 3)
    phi = math.radians(table.number("phi_deg")) if table.has("phi_deg") else None
    within = tolerance(table, "tolerance_m")
    if table.has("tolerance_deg") and phi is None:
        raise table.fail("tolerance_deg", "expected phi_deg with it")
    far = float(np.linalg.norm(position - robot.arm.base[:3, 3])) - robot.arm.reach
    if far > within:
        raise table.fail("position", f"it is {far:.3f} m out of the reach of {robot.name}")
    return ToolAt(position, within, phi, math.radians(tolerance(table, "tolerance_deg", 1.0)))


CHECK = CheckType("tool_at", 10, read)
