"""The film of the coils: one even turn, or the rotor that is let go."""

from __future__ import annotations

import math

from armlab.benches.drive.torque.state import CLIP_KEY, TURN, Torque
from armlab.session.parts.timeline import Clip
from armlab.session.state import State


def _stops(state: State) -> tuple[float, ...]:
    """Return the times at which the torque of the first coil is zero or largest, of an even turn."""
    part = state[Torque]
    if part.motion != "turned":
        return ()
    first = math.ceil(part.start / (0.5 * math.pi) + 1e-9)
    angles = (0.5 * math.pi * (first + k) - part.start for k in range(4))
    return tuple(TURN * angle / (2.0 * math.pi) for angle in angles if angle < 2.0 * math.pi - 1e-9)


CLIP = Clip(CLIP_KEY, "Coils", lambda state: state[Torque].end, _stops, lambda state, time: state, panel="torque")
