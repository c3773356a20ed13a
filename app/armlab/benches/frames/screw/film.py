"""The screw motion over the time of the film, and the straight way with an even turn beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.frames.screw.state import CLIP_KEY, Screw
from armlab.kin.screw_motion import ScrewMotion, screw_motion
from armlab.kin.transforms import inverse, transform
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

Floats = NDArray[np.float64]

DURATION = 4.0
"""Duration of the film, seconds."""

STOPS = (1.0, 2.0, 3.0)
"""Stops of stepping, seconds."""


@dataclass(frozen=True, eq=False)
class Ways:
    """Both ways from pose 1 to pose 2.

    Attributes
    ----------
    first, second : ndarray, shape (4, 4)
        The poses in the world.
    screw : ScrewMotion
        Of ``T2 T1^-1``: axis and twist are written in the world.
    """

    first: Floats
    second: Floats
    screw: ScrewMotion

    def at(self, s: ArrayLike) -> Floats:
        """Return the poses (..., 4, 4) of the screw motion at parts (...) from 0 to 1: ``exp([S] theta s) T1``."""
        return np.asarray(self.screw.at(s) @ self.first)

    def straight(self, s: ArrayLike) -> Floats:
        """Return the poses (..., 4, 4) of the straight way, which turns as the screw does, also by half a turn."""
        share = np.asarray(s, dtype=float)
        p, end = self.first[:3, 3], self.second[:3, 3]
        return np.asarray(transform(self.at(share)[..., :3, :3], p + share[..., None] * (end - p)))

    @property
    def foot(self) -> Floats:
        """The point of the axis that is nearest to pose 1, (3,); the origin of pose 1 where nothing turns."""
        p = self.first[:3, 3]
        return self.screw.foot(p) if self.screw.kind in ("rotation", "screw") else p

    @property
    def radius(self) -> float:
        """The distance of the origin of pose 1 from the axis, metres; 0 where nothing turns."""
        return float(np.linalg.norm(self.first[:3, 3] - self.foot))

    @property
    def length(self) -> float:
        """The length of the way of the origin on the screw, metres: of a helix, ``sqrt((r theta)^2 + d^2)``."""
        return math.hypot(self.radius * self.screw.angle, self.screw.distance)

    @property
    def chord(self) -> float:
        """The length of the straight way, metres."""
        return float(np.linalg.norm(self.second[:3, 3] - self.first[:3, 3]))


def ways_of(state: State) -> Ways:
    """Return both ways between the poses."""
    part = state[Screw]
    first, second = part.pose("first"), part.pose("second")
    return Ways(first, second, screw_motion(second @ inverse(first)))


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its middle while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.5 * DURATION


def part_of(state: State) -> float:
    """Return which part of the motion is made, from 0 to 1."""
    return film_time(state) / DURATION
