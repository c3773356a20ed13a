"""Films of a few steps on the shared timeline: where they stand, and how they are put where a step ends."""

from __future__ import annotations

from armlab.benches.body.forms.timing import DURATION, ENDS
from armlab.errors import InputError
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State


def time_of(state: State, clip: str, end: float = DURATION) -> float:
    """Return the time of a film in seconds; its end while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == clip else end


def with_film_at(state: State, clip: str, made: int, what: str, ends: tuple[float, ...] = ENDS) -> State:
    """Return the state with a film of steps open where that many are made; `InputError` for more.

    Parameters
    ----------
    state : State
    clip : str
        Key of the film.
    made : int
    what : str
        What the steps are called.
    ends : tuple of float
        Ends of the steps, seconds.
    """
    if not 0 <= made <= len(ends):
        raise InputError(f"{what}: expected 0 to {len(ends)}, got {made}")
    if state[Timeline].clip != clip or state[Timeline].playing:
        state = OpenClip(clip).apply(OpenClip("").apply(state))
    return Seek((0.0, *ends)[made]).apply(state)
