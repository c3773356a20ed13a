"""A film: two rotations, and beside them the same two in the other order."""

from __future__ import annotations

from armlab.benches.body.order.state import CLIP_KEY, ENDS
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Order of rotations",
    lambda state: ENDS[-1],
    lambda state: ENDS[:-1],
    lambda state, time: state,
    panel="order",
)
