"""A film: a rotation about any axis in three steps, and beside it at once."""

from __future__ import annotations

from armlab.benches.body.axis.state import CLIP_KEY
from armlab.benches.body.forms.timing import DURATION, ENDS
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Rotation in three steps",
    lambda state: DURATION,
    lambda state: ENDS[:-1],
    lambda state, time: state,
    panel="axis",
)
