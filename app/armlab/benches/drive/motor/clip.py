"""The film of the motor: its run, in seconds of the motor."""

from __future__ import annotations

from armlab.benches.drive.motor.state import CLIP_KEY, Motor
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

CONSTANTS = (1.0, 2.0, 3.0, 5.0)
"""Mechanical time constants after the last change at which stepping stops."""


def _stops(state: State) -> tuple[float, ...]:
    """Return the times at which voltage or load change, and some time constants after the last of them."""
    part = state[Motor]
    changes = [float(time) for time in part.run.edges[1:-1]] if len(part.pieces) <= 8 else []
    last = changes[-1] if changes else 0.0
    later = [last + count * part.motor.mechanical_constant for count in CONSTANTS]
    return tuple(time for time in (*changes, *later) if 0.0 < time < part.end)


CLIP = Clip(CLIP_KEY, "DC motor", lambda state: state[Motor].end, _stops, lambda state, time: state, panel="motor")
