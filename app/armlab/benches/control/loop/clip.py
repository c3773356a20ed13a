"""The film of the velocity loop, which runs through the time and the numbers of the block diagram."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.control.loop.state import CLIP_KEY, Loop
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

TIME_CONSTANTS = 5
"""Number of time constants of a step at which stepping through the film stops."""


def _stops(state: State) -> tuple[float, ...]:
    """Return the quarters of a sine's period, or the first time constants of a step."""
    part = state[Loop]
    if part.kind == "step":
        times = part.loop.time_constant * np.arange(1, TIME_CONSTANTS + 1)
    else:
        quarter = 0.5 * math.pi / part.omega
        times = quarter * np.arange(1, 1 + math.floor(part.end / quarter))
    return tuple(times[times < part.end].tolist())


CLIP = Clip(CLIP_KEY, "Velocity loop", lambda state: state[Loop].end, _stops, lambda state, time: state, panel="loop")
