"""The place where a table stands at first: such that the arm reaches the object on it with its tool pointing down."""

from __future__ import annotations

import itertools
import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.kin import ik
from armlab.kin.transforms import inverse, transform

Floats = NDArray[np.float64]

FIGURES = 2
"""Number of figures to which lengths at first are rounded."""

RADII, HEIGHTS, TURNS = (1.0, 0.8, 1.2, 0.6), (0.1, 0.0, 0.3, -0.2, -0.5, 0.6), (0.0, 0.5, -0.5)
"""Distances of the object from the first axis and heights of the table, in length scales of the arm, and angles from
the direction in which the arm points at home, radians: the first that the arm reaches is taken."""

SEARCHES = 2
KEPT = 64
DECIMALS = 3
"""Starts of the inverse kinematics for each place, number of arms whose tables are kept, and decimals of the place."""


def rounded_length(value: float) -> float:
    """Return a length with `FIGURES` figures.

    >>> rounded_length(0.2161)
    0.22
    """
    return round(value, FIGURES - 1 - math.floor(math.log10(value))) if value > 0.0 else 0.0


@lru_cache(maxsize=KEPT)
def table_for(robot: Robot, shares: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return the origin of the frame of a table in the world, metres; its axes are those of the world.

    Parameters
    ----------
    robot : Robot
    shares : (float, float, float)
        Place of the object on the table and height of the tool above it, in length scales of the arm.

    Returns
    -------
    (float, float, float)
        Such that the arm reaches the object; the first place that was tried for an arm that cannot.
    """
    arm, home = robot.arm, np.array(robot.home, dtype=float)
    px, py, h = (rounded_length(share * arm.length_scale) for share in shares)
    azimuth = _pointing(robot)
    places = [
        _corner(robot, radius, azimuth + turn, height, px, py)
        for height, radius, turn in itertools.product(HEIGHTS, RADII, TURNS)
    ]
    for corner in places:
        wanted = transform(np.diag([1.0, -1.0, -1.0]), corner + np.array([px, py, h]))
        if ik.solve(arm, wanted, home, searches=SEARCHES, complete=False).success:
            return _three(corner)
    return _three(places[0])


def _pointing(robot: Robot) -> float:
    """Return the azimuth of the tool at home about the axis of the base, radians."""
    x, y, _ = (inverse(robot.arm.base) @ robot.arm.fk(np.array(robot.home, dtype=float)))[:3, 3]
    return math.atan2(y, x)


def _corner(robot: Robot, radius: float, azimuth: float, height: float, px: float, py: float) -> Floats:
    arm = robot.arm
    size = arm.length_scale
    at = (
        arm.base[:3, :3] @ [radius * size * math.cos(azimuth), radius * size * math.sin(azimuth), 0.0] + arm.base[:3, 3]
    )
    at[2] = arm.base[2, 3] + height * size
    return np.round(at - [px, py, 0.0], DECIMALS)


def _three(corner: Floats) -> tuple[float, float, float]:
    x, y, z = (float(value) + 0.0 for value in corner)
    return x, y, z
