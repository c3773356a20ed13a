"""A film: three turns of the first wheel."""

from __future__ import annotations

from armlab.benches.drive.gears.film import DURATION, TURN, TURNS
from armlab.benches.drive.gears.state import CLIP_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Turning wheels",
    lambda state: DURATION,
    lambda state: tuple(TURN * k for k in range(1, TURNS)),
    lambda state, time: state,
    panel="gears",
)
