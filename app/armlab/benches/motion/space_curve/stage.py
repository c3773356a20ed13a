"""Place and size of a curve in the scene: in the world, or as a model beside an arm that is much smaller."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.space_curve.laid import Point, Question, laid
from armlab.benches.motion.space_curve.state import SpaceCurve
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State

Floats = NDArray[np.float64]

NEAR = 1.05
"""Distance from the base, in reaches of the arm, up to which a curve is drawn in its place."""

MODEL = 0.26
"""Largest extent of a model, in reaches of the arm."""

ASIDE = 0.19
"""Distance from the base to the middle of a model, and of the sphere of the orientations, in reaches: to the left in
the home view of the arm, where no arm has its tool."""

STEPS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
"""Ratios of a model, up to a power of ten."""

ABOVE = 0.06
"""Height of the lowest point of a model above the base, in reaches."""

SPHERE, SPHERE_HEIGHT = 0.115, 0.26
"""Radius of the sphere for the tips, and height of its centre, in reaches."""

ACROSS, SMALL, LARGE = 0.2, 0.07, 0.24
"""Length of the drawn vectors relative to the extent of the curve, and its least and largest value in reaches."""


class Stage(NamedTuple):
    """The map from points in metres to the drawing: shift + factor p.

    Attributes
    ----------
    factor : float
        1 where a curve is drawn in its place.
    shift : ndarray, shape (3,)
        Metres.
    length : float
        Of unit vectors, metres in the scene.
    reach : float
        Of the arm, metres.
    """

    factor: float
    shift: Floats
    length: float
    reach: float

    def at(self, points: Floats) -> Floats:
        """Return the places of points (..., 3) in the drawing."""
        return np.asarray(self.shift + self.factor * points)

    @property
    def model(self) -> bool:
        """Whether the curve is not drawn in its place."""
        return bool(self.shift.any())

    @property
    def ratio(self) -> float:
        """Number of metres that are drawn as one."""
        return 1.0 / self.factor


def stage_of(state: State) -> Stage:
    """Return the stage of a state's curve."""
    base, beside, reach = _arm(state)
    return _stage(state[SpaceCurve].question, _tuple(base), _tuple(beside), reach)


@lru_cache(maxsize=64)
def _stage(question: Question, centre: Point, beside: Point, reach: float) -> Stage:
    base = np.array(centre)
    points = np.concatenate([laid(question).frame.position, np.array(question.points).reshape(-1, 3)])
    low, high = points.min(axis=0), points.max(axis=0)
    extent = float(np.linalg.norm(high - low))
    if np.linalg.norm(points - base, axis=1).max() <= NEAR * reach:
        return Stage(1.0, np.zeros(3), _length(extent, reach), reach)
    factor = 1.0 / _ratio(extent / (MODEL * reach))
    middle = 0.5 * factor * (low + high)
    place = np.array(beside) + np.array([0.0, 0.0, ABOVE * reach])
    shift = place - np.array([middle[0], middle[1], factor * low[2]])
    return Stage(factor, shift, _length(factor * extent, reach), reach)


def sphere_of(state: State) -> tuple[Floats, float]:
    """Return centre (3,) and radius of the sphere for the tips of the axes, metres."""
    _, beside, reach = _arm(state)
    return beside + np.array([0.0, 0.0, SPHERE_HEIGHT * reach]), SPHERE * reach


def _arm(state: State) -> tuple[Floats, Floats, float]:
    """Return the base of the arm, the place beside it, and its reach, metres."""
    robot = state[RobotPart].robot
    base, reach = np.asarray(robot.arm.base[:3, 3], dtype=np.float64), 2.0 * robot.arm.length_scale
    azimuth = math.radians(robot.camera.azimuth_deg)
    left = np.array([math.sin(azimuth), -math.cos(azimuth), 0.0])
    return base, base + ASIDE * reach * left, reach


def _tuple(point: Floats) -> Point:
    x, y, z = point.tolist()
    return x, y, z


def _length(extent: float, reach: float) -> float:
    return min(max(ACROSS * extent, SMALL * reach), LARGE * reach)


def _ratio(least: float) -> float:
    """Return the next ratio of `STEPS`, times a power of ten, that is not smaller; 1 or more."""
    if least <= 1.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in STEPS if step * power >= least * (1.0 - 1e-9))
