"""The film of the incremental encoder, which runs through its moves."""

from __future__ import annotations

from armlab.benches.sensor.incremental.state import CLIP_KEY, Incremental
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

MOST_STOPS = 200
"""Largest number of edges at each of which stepping stops."""


def _stops(state: State) -> tuple[float, ...]:
    """Return the times of the edges or, where they are too many, those between the moves."""
    part = state[Incremental]
    times = part.signals.times if len(part.signals.times) <= MOST_STOPS else part.motion.times
    return tuple(time for time in times.tolist() if 0.0 < time < part.motion.duration)


CLIP = Clip(
    CLIP_KEY,
    "Incremental encoder",
    lambda state: state[Incremental].motion.duration,
    _stops,
    lambda state, time: state,
    panel="incremental_encoder",
)
