"""The clips that count as played in a step of a lesson."""

from __future__ import annotations

from armlab.session.parts.timeline import Timeline, duration
from armlab.session.state import State
from armlab.teaching.taught import taught


def films_played(films: frozenset[str], before: State, now: State) -> frozenset[str]:
    """Return the clips that count as played after a change: those before it and the one that has come to its end.

    A clip that is made on a bench counts only while it is unchanged.
    """
    still = films - {each.clip for each in taught() if each.clip in films and each.changed(before, now)}
    return still | _just_played(before, now)


def _just_played(before: State, now: State) -> frozenset[str]:
    """Return the clip that has just come to its end, if any."""
    was, timeline = before[Timeline], now[Timeline]
    if timeline is was or not timeline.clip or timeline.time < duration(now):
        return frozenset()
    if not all(each.ended(before, now) for each in taught() if each.clip == timeline.clip):
        return frozenset()
    return frozenset({timeline.clip})
