"""A film: three turns of the input of a harmonic drive."""

from __future__ import annotations

from armlab.benches.drive.harmonic.film import DURATION
from armlab.benches.drive.harmonic.state import CLIP_KEY, TURN, TURNS
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Harmonic drive",
    lambda state: DURATION,
    lambda state: tuple(TURN * k for k in range(1, TURNS)),
    lambda state, time: state,
    panel="harmonic",
)
