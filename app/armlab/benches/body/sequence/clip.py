"""A film: three turns about moving axes, and beside them three about fixed axes."""

from __future__ import annotations

from armlab.benches.body.forms.timing import DURATION, ENDS
from armlab.benches.body.sequence.state import CLIP_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Euler & RPY angles",
    lambda state: DURATION,
    lambda state: ENDS[:-1],
    lambda state, time: state,
    panel="sequence",
)
