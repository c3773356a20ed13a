"""The film of the absolute encoder: one turn of the disk."""

from __future__ import annotations

import numpy as np

from armlab.benches.sensor.absolute.state import CLIP_KEY, Absolute
from armlab.benches.sensor.absolute.turning import DURATION, turned_to
from armlab.kin.sensors.absolute import TURN
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

MOST_STOPS = 64
"""Largest number of sectors at each of which stepping stops."""


def _stops(state: State) -> tuple[float, ...]:
    """Return the times of the edges of the sectors, or of as many of them."""
    parts = min(2 ** state[Absolute].tracks, MOST_STOPS)
    return tuple((DURATION * np.arange(1, parts) / parts).tolist())


CLIP = Clip(
    CLIP_KEY,
    "Absolute encoder",
    lambda state: DURATION,
    _stops,
    lambda state, time: turned_to(state, TURN * time / DURATION),
    panel="absolute_encoder",
)
