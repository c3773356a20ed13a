"""Films of three steps on the shared timeline: where they stand, and how they are put where a step ends."""

from __future__ import annotations

from armlab.benches.body.forms.timing import DURATION, ENDS
from armlab.errors import InputError
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State


def time_of(state: State, clip: str) -> float:
    """Return the time of a film in seconds; its end while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == clip else DURATION


def with_film_at(state: State, clip: str, made: int, what: str) -> State:
    """Return the state with a film of three steps open where that many are made; `InputError` for more."""
    if not 0 <= made <= len(ENDS):
        raise InputError(f"{what}: expected 0 to {len(ENDS)}, got {made}")
    if state[Timeline].clip != clip or state[Timeline].playing:
        state = OpenClip(clip).apply(OpenClip("").apply(state))
    return Seek((0.0, *ENDS)[made]).apply(state)
