"""A film: two whole turns about an axis, after which the quaternion is back as well."""

from __future__ import annotations

from armlab.benches.body.quaternion.film import DURATION, STOPS
from armlab.benches.body.quaternion.state import CLIP_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(
    CLIP_KEY,
    "Two whole turns",
    lambda state: DURATION,
    lambda state: STOPS,
    lambda state, time: state,
    panel="quaternion",
)
