"""The film of the wheels: the first one turns so slowly that the teeth can be followed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.gears.state import CLIP_KEY, Gears
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

TURN = 4.0
"""Time in which the first wheel turns once, seconds."""

TURNS = 3
"""Number of turns of the first wheel in the film."""

DURATION = TURNS * TURN


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its start while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def turned_at(part: Gears, time: float) -> float:
    """Return by how much the first wheel is turned, radians, in the sense of the motor."""
    return math.copysign(2.0 * math.pi * time / TURN, part.speed) if part.speed else 0.0


def angles_at(part: Gears, time: float) -> NDArray[np.float64]:
    """Return the angle of each wheel at a time of the film, radians, shape (k,)."""
    return part.train.angles(turned_at(part, time))


def slowed(part: Gears) -> float:
    """Return how many times as fast the motor turns as the first wheel of the film; 0 while it stands."""
    return abs(part.speed) * TURN / (2.0 * math.pi)
