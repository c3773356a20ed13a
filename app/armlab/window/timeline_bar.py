"""The bar of the timeline over the scene: play, pause, scrub, step, loop, speed."""

from __future__ import annotations

import json
import math

import viser

from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Play, Seek, Step, Timeline, clips, duration
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag

_SHAPES = {
    "play": "M4 2v12l10-6z",
    "pause": "M3 2h4v12H3zM9 2h4v12H9z",
    "back": "M2 2h2.5v12H2zM14 2v12L5.5 8z",
    "forward": "M11.5 2H14v12h-2.5zM2 2v12l8.5-6z",
}
"""Drawn shapes of the buttons, because not every computer has letters for them."""

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)


class TimelineBar:
    """The bar in one browser, which appears while a clip is open.

    The bar itself is rewritten only when something but the time has changed, or a hand on its thumb would lose it. The
    time goes to the page in a mark of its own, and the page's script moves the thumb between two marks by its clock.
    """

    def __init__(self, client: viser.ClientHandle, post: Post) -> None:
        self._bar = Form(lambda on_input: Fields(client.gui, on_input), post, lambda: None, beside=False)
        self._clock = Fields(client.gui, lambda _cell, _text: None)

    def show(self, state: State, open_panels: frozenset[str]) -> None:
        """Show the timeline of a state; it is hidden for a clip of which there is nothing to see on the open pages."""
        timeline = state[Timeline]
        if not timeline.seen(open_panels):
            self._bar.show()
            self._clock.show()
            return
        end = duration(state)
        self._bar.show(self._markup(timeline, end, clips()[timeline.clip].stops(state)))
        rate = timeline.speed if timeline.playing else 0.0
        mark = {"time": timeline.time, "end": end, "rate": rate, "clip": timeline.clip}
        self._clock.show(tag("i", id="al-clock", hidden=True, data_clock=json.dumps(mark)))

    def _markup(self, timeline: Timeline, end: float, stops: tuple[float, ...]) -> Markup:
        def button(
            cell: str, sign: Inside, title: str, command: Command, key: str = "", pressed: bool | None = None
        ) -> Markup:
            return self._bar.button(cell, sign, command, hint=title, label=title, pressed=pressed, data_key=key)

        marks = [tag("i", style=f"left:{100.0 * t / end:.3f}%") for t in stops if 0.0 < t < end]
        speeds = sorted({*SPEEDS, timeline.speed})
        texts = {f"{s:g}": f"{s:g}×" for s in speeds}
        seek = self._bar.bound("seek", lambda text: Seek(_number(text) * end))
        chosen, begin_again = f"{timeline.speed:g}", Set(Timeline, "loop", not timeline.loop)
        play = ("pause", "Pause (space)") if timeline.playing else ("play", "Play (space)")
        thumb = tag("input", type="range", min=0, max=1, step="any", aria_label="Time", data_live=1, **seek)
        return tag(
            "div.al-over.al-time",
            tag("b", clips()[timeline.clip].title),
            button("back", _sign("back"), "One step back (comma)", Step(False), "Comma"),
            button("play", _sign(play[0]), play[1], Play(not timeline.playing), "Space"),
            button("forward", _sign("forward"), "One step forward (full stop)", Step(True), "Period"),
            tag("span.track", tag("span.stops", marks), thumb),
            tag("span.now"),
            button("loop", "⟳", "Begin again at the end", begin_again, pressed=timeline.loop),
            self._bar.select("speed", "Speed", texts, chosen, _speed, "Speed"),
            button("close", "✕", "Close", OpenClip("")),
            role="group",
            aria_label="Timeline",
        )


def _sign(name: str) -> Markup:
    return tag("svg", tag("path", d=_SHAPES[name]), viewBox="0 0 16 16", width=13, height=13, aria_hidden="true")


def _speed(text: str) -> Command:
    return Set(Timeline, "speed", _number(text))


def _number(text: str) -> float:
    """Return a number sent by the lab's own page; `InputError` otherwise."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"timeline: expected a number, got {text[:40]!r}")
    return value
