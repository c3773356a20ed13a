"""A film: two bodies that turn by two time laws of omega."""

from __future__ import annotations

from armlab.benches.body.integral.film import duration_of, stops_of
from armlab.benches.body.integral.state import CLIP_KEY
from armlab.session.parts.timeline import Clip

CLIP = Clip(CLIP_KEY, "Integral of ω", duration_of, stops_of, lambda state, time: state, panel="integral")
