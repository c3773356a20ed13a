"""The button of a page that plays its film, and the field of its time."""

from __future__ import annotations

from armlab.errors import InputError
from armlab.session.amounts import amount
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.html import Markup, tag
from armlab.ui.units import plain_number

SPACE = "Space"
"""The key of what an open page plays; see `armlab.js`."""


def by_space(hint: str = "") -> str:
    """Return the hint of a button that the space bar presses while its page is open."""
    return f"{hint}. Space plays and pauses" if hint else "Space plays and pauses"


def play_button(
    form: Form,
    state: State,
    clip: str,
    name: str,
    word: str = "Play",
    kind: str = "main",
    hint: str = "",
    off: bool = False,
) -> Markup:
    """Return the button that plays a film, pauses it, or continues it; the space bar presses it, too.

    Parameters
    ----------
    form : Form
    state : State
    clip : str
        Key of the film.
    name : str
        Its cells are ``play-name`` and ``pause-name``.
    word, kind, hint : str
        What stands on it, its class, and what is said of it.
    off : bool
        Whether there is nothing to play.
    """
    timeline = state[Timeline]
    on = timeline.clip == clip
    hint = by_space(hint)
    if on and timeline.playing:
        return form.button(f"pause-{name}", "❚❚ Pause", Play(False), kind, hint, data_key=SPACE)
    action = Play(True) if on else OpenClip(clip, play=True)
    return form.button(f"play-{name}", f"▶ {word}", action, kind, hint, off=off, data_key=SPACE)


def clock(form: Form, state: State, clip: str, end: float, closed: float = 0.0) -> Markup:
    """Return the button of a film that takes ``end`` seconds, and the field of its time, with the clip in the cells.

    ``closed`` is the time that the page shows while the film is closed.
    """
    on = state[Timeline].clip == clip
    now = state[Timeline].time if on else closed
    typed = form.field("time", amount(now), "Time in seconds", lambda text: _to_time(text, clip, end, on))
    play = play_button(form, state, clip, clip)
    return tag("div.bar.kit-clock", play, tag("label", "t = ", typed, " ", tag("i", f"of {amount(end, 's')}")))


def _to_time(text: str, clip: str, end: float, on: bool) -> tuple[Command, ...]:
    time = plain_number(text, "t", "seconds")
    if amount(time) == amount(end):  # the end as the page writes it, rounded
        time = end
    if not 0.0 <= time <= end:
        raise InputError(f"t: expected 0 to {amount(end, 's')}, got {amount(time)}")
    return (Seek(time),) if on else (OpenClip(clip), Seek(time))
