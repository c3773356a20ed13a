"""A body turns: its three angles grow with their rates, or two of them follow two time laws of omega."""

from __future__ import annotations

from armlab.benches.velocity.turning.motion import DURATION
from armlab.benches.velocity.turning.state import CLIP_KEY, Turning
from armlab.session.parts.timeline import Clip
from armlab.session.state import State


def _stops(state: State) -> tuple[float, ...]:
    """Return the times at which omega changes."""
    return (1.0,) if state[Turning].shown == "laws" else ()


CLIP = Clip(
    CLIP_KEY,
    "Angular velocity",
    lambda state: DURATION[state[Turning].shown],
    _stops,
    lambda state, time: state,
    panel="turning",
)
