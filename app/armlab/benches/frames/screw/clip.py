"""A film: the screw motion from one pose to another, at an even rate."""

from __future__ import annotations

from armlab.benches.frames.screw.film import DURATION, STOPS
from armlab.benches.frames.screw.state import CLIP_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Screw motion",
    lambda state: DURATION,
    lambda state: STOPS,
    lambda state, time: state,
    panel="screw",
)
