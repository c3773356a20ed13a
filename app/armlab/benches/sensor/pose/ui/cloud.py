"""The attained positions around the commanded one, magnified so that they can be seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.pose.state import found
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]

SEEN = 0.14
"""Distance of the farthest attained position from the commanded one in the scene, in sizes of the arm, at most."""

STEPS = (1.0, 2.0, 5.0)
"""First digits of a magnification."""

MOST = 1e9
"""Largest magnification."""


@dataclass(frozen=True, eq=False)
class Cloud:
    """Attained positions, magnified about the commanded one.

    Attributes
    ----------
    magnification : float
    commanded, mean : ndarray, shape (3,)
        Metres; the barycentre is magnified, too.
    points : ndarray, shape (n, 3)
    radius : float
        RP, magnified, metres.
    """

    magnification: float
    commanded: Floats
    mean: Floats
    points: Floats
    radius: float


def magnification(farthest: float, size: float) -> float:
    """Return the largest of 1, 2, 5, 10, ... with which an error in metres is seen in an arm of this size; at least 1.

    >>> magnification(1e-4, 1.0), magnification(0.0, 1.0), magnification(0.5, 1.0)
    (1000.0, 1.0, 1.0)
    """
    room = SEEN * size / farthest if farthest > 0.0 else 1.0
    if not 1.0 < room < MOST:
        return MOST if room >= MOST else 1.0
    power = 10.0 ** math.floor(math.log10(room))
    return max(step * power for step in STEPS if step * power <= room)


def cloud_of(state: State) -> Cloud:
    """Return the attained positions of the present arm."""
    figures, size = state.derived(found).figures, state[Joints].arm.reach
    commanded = figures.commanded[:3, 3]
    away = figures.poses[:, :3, 3] - commanded
    farthest = max(
        float(np.linalg.norm(away, axis=1).max()), figures.position.accuracy + figures.position.repeatability
    )
    times = magnification(farthest, size)
    mean = commanded + times * (figures.position.middle - commanded)
    return Cloud(times, commanded, mean, commanded + times * away, times * figures.position.repeatability)


def around(state: State) -> Floats:
    """Return the corners (2, 3) of what belongs in the picture beside the arm."""
    cloud = state.derived(cloud_of)
    both = np.stack([cloud.mean - cloud.radius, cloud.mean + cloud.radius, *cloud.points])
    return np.stack([both.min(axis=0), both.max(axis=0)])
