"""The film of timing laws: all begin together, and each moves by its own law."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State


def present_time(state: State) -> float:
    """Return the seconds since the laws began, or 0 while their film is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def _stops(state: State) -> tuple[float, ...]:
    """Return the times at which one formula of a law ends and the next begins."""
    edges = np.concatenate([law.edges[1:] for law in state[Laws].every])
    return tuple(np.unique(edges[edges < state[Laws].end]).tolist())


CLIP = Clip(
    CLIP_KEY,
    "Timing laws",
    lambda state: state[Laws].end,
    _stops,
    lambda state, time: state,
    panel="laws",
)
