"""A film: the way from one orientation to another."""

from __future__ import annotations

from armlab.benches.body.quaternion.between import DURATION, STOP
from armlab.benches.body.quaternion.state_view import WAY_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    WAY_KEY,
    "Between two orientations",
    lambda state: DURATION,
    lambda state: (STOP,),
    lambda state, time: state,
    panel="quaternion",
)
