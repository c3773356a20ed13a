"""The tool is on a line, a circle or a plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import PLAIN, CheckType, Words, length_tolerance, tolerance, with_edge
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

Vector = NDArray[np.float64]

SAMPLES, OFTEN = 500, 0.25
"""Number of random configurations, with a fixed seed, and the fraction that may meet a check by chance."""


@dataclass(frozen=True, eq=False)
class Place:
    """A set of points in the world; ``nearest`` returns its point nearest to a given one."""

    name: str
    nearest: Callable[[Vector], Vector]


@dataclass(frozen=True, eq=False)
class OnLine:
    """The tool point is within a distance in metres of the place."""

    place: Place
    within: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether the tool point is near enough."""
        return self.distance(observation.tool_pose[:3, 3]) <= with_edge(self.within)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the distance of the tool and the direction towards the place."""
        p = observation.tool_pose[:3, 3]
        distance, way = self.distance(p), self.place.nearest(p) - p
        if distance <= with_edge(self.within):
            return f"The tool is on the {self.place.name}."
        k = int(np.argmax(np.abs(way)))
        more = "larger" if way[k] > 0.0 else "smaller"
        return f"The tool is {words.length(distance)} away from the {self.place.name}: its {'xyz'[k]} has to be {more}."

    def distance(self, p: Vector) -> float:
        """Return the distance of a point in the world, metres."""
        return float(np.linalg.norm(self.place.nearest(p) - p))


def line(point: Vector, direction: Vector) -> Place:
    """Return the line through a point along a unit vector."""
    return Place("line", lambda p: point + ((p - point) @ direction) * direction)


def plane(point: Vector, normal: Vector) -> Place:
    """Return the plane through a point, perpendicular to a unit vector."""
    return Place("plane", lambda p: p - ((p - point) @ normal) * normal)


def circle(centre: Vector, normal: Vector, radius: float) -> Place:
    """Return the circle about a point in the plane perpendicular to a unit vector."""

    def nearest(p: Vector) -> Vector:
        flat = (p - centre) - ((p - centre) @ normal) * normal
        length = float(np.linalg.norm(flat))
        if length < 1e-12 * radius:  # on the axis all points of the circle are equally near
            flat = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
            length = float(np.linalg.norm(flat))
        return np.asarray(centre + radius * flat / length)

    return Place("circle", nearest)


def read(table: Table, robot: Robot) -> OnLine:
    """Read ``shape`` (line, circle, plane), ``point`` (of a circle its centre) and ``tolerance_m``.

    Then ``direction`` of a line; ``normal`` of a plane; ``normal`` and ``radius`` of a circle.
    """
    shape, point = table.choice("shape", ("line", "circle", "plane"), "line"), table.numbers("point", 3)
    within = length_tolerance(table, robot)
    if shape == "line":
        place = line(point, _direction(table, "direction"))
    elif shape == "plane":
        place = plane(point, _direction(table, "normal"))
    else:
        place = circle(point, _direction(table, "normal"), tolerance(table, "radius"))
    check, base = OnLine(place, within), robot.arm.base[:3, 3]
    far = check.distance(base) - robot.arm.reach
    if far > within:
        raise table.fail("point", f"the {shape} is {far:.3f} m out of the reach of {robot.name}")
    limits = robot.arm.limits
    q = np.random.default_rng(0).uniform(limits[:, 0], limits[:, 1], (SAMPLES, robot.arm.n))
    met = float(np.mean([check.distance(p) <= within for p in np.asarray(robot.arm.position(q))]))
    if met > OFTEN:
        raise table.fail("shape", f"the tool of {robot.name} is there in {met:.0%} of all poses; nothing is to be done")
    return check


def _direction(table: Table, key: str) -> Vector:
    vector = table.numbers(key, 3)
    length = float(np.linalg.norm(vector))
    if not 1e-9 < length < 1e9:
        raise table.fail(key, f"expected a direction that is not zero, got {vector.tolist()}")
    return vector / length


CHECK = CheckType("on_line", 50, read)
