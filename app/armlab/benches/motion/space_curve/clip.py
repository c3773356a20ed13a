"""The film of the page of geometry: once along the curve, or from one orientation to the other."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.space_curve.state import CLIP_KEY, SpaceCurve, curve_of
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

PARTS = 8
"""Number of equal parts of the duration at which stepping stops, besides the ends of pieces of the motion."""

MOST_PIECES = 24


def _duration(state: State) -> float:
    return state.derived(curve_of).law.duration


def _stops(state: State) -> tuple[float, ...]:
    end = _duration(state)
    even = np.linspace(0.0, end, PARTS + 1)[1:-1]
    if state[SpaceCurve].shown == "turn":
        return tuple(even.tolist())
    pieces = state.derived(curve_of).motion.pieces
    if len(pieces) > MOST_PIECES:
        return tuple(even.tolist())
    apart = [t for t in even if not len(pieces) or np.abs(pieces - t).min() > 0.02 * end]
    return tuple(sorted([*pieces.tolist(), *apart]))


CLIP = Clip(CLIP_KEY, "Curve in space", _duration, _stops, lambda state, time: state, panel="space_curve")
