"""Where in the scene a curve is drawn, and how large: in the world, or as a model beside an arm it would dwarf."""

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
"""Reaches of the arm from its base within which a curve is drawn where it is."""

MODEL = 0.26
"""Reaches of the arm that a model is across at most."""

ASIDE = 0.19
"""How far beside the base the middle of a model, and of the sphere of the orientations, is: to the left as the arm is
looked at from its home view, where no arm has its tool. In reaches."""

STEPS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
"""Ratios of a model, up to a power of ten."""

ABOVE = 0.06
"""Height of the lowest point of a model over the base, in reaches."""

SPHERE, SPHERE_HEIGHT = 0.115, 0.26
"""Radius of the sphere on which the tips run, and height of its centre, in reaches."""

ACROSS, SMALL, LARGE = 0.2, 0.07, 0.24
"""Length of the drawn vectors: of the extent of the curve; at least and at most in reaches."""


class Stage(NamedTuple):
    """How points in metres are drawn: shift + factor p.

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
        """Return where points (..., 3) are drawn."""
        return np.asarray(self.shift + self.factor * points)

    @property
    def model(self) -> bool:
        """Whether it is not drawn in its place."""
        return bool(self.shift.any())

    @property
    def ratio(self) -> float:
        """How many metres are drawn as one."""
        return 1.0 / self.factor


def stage_of(state: State) -> Stage:
    """Return where the curve of a state is drawn."""
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
    """Return centre (3,) and radius of the sphere on which the tips of the axes run, metres."""
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
    """Return the next ratio of `STEPS`, times a power of ten, that is not below; 1 or more."""
    if least <= 1.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in STEPS if step * power >= least * (1.0 - 1e-9))
