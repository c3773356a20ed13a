"""Timing laws side by side: s and its derivatives, peaks and classes, time scaling, and bounds on a path."""

from __future__ import annotations

from armlab.benches.motion.laws.clip import present_time
from armlab.benches.motion.laws.commands import Stretch
from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.benches.motion.laws.ui.form import form_markup, head_markup, scaling_markup
from armlab.benches.motion.laws.ui.plots import Plots, race_markup
from armlab.benches.motion.laws.ui.tables import bounds_markup, stretch_markup, values_markup
from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.session.amounts import amount
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

SLOWEST, FASTEST, STEP = 5.0, 0.1, 0.005
"""Ends and step of the slider of k."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make form, plots, tables, the slider of k and the calculator."""
    head, bounds, form, clock = gui.form(post), gui.form(post), gui.form(post), gui.form(post)
    plots, values = Plots(gui), gui.html()
    scaling = gui.form(post)
    slider = gui.slider("k", FASTEST, SLOWEST, STEP, 1.0, lambda k: post(Stretch(k)), "New time over old time")
    after = gui.html()

    def show(state: State) -> None:
        part = state[Laws]
        head.show(head_markup(head, part))
        bounds.show(bounds_markup(bounds, part.bounded) if part.bounds_shown else "")
        form.show(form_markup(form, part))
        clock.show(clock_markup(clock, state))
        plots.show(state)
        values.show(values_markup(part, present_time(state)))
        scaling.show(scaling_markup(scaling, part))
        slider.show(round(min(max(part.k, FASTEST), SLOWEST), 5))
        after.show(stretch_markup(part))

    return show


def clock_markup(form: Form, state: State) -> str:
    """Return play and time, and the race of the laws."""
    on, end = state[Timeline].clip == CLIP_KEY, state[Laws].end
    if on and state[Timeline].playing:
        play = form.button("pause-laws", "❚❚ Pause", Play(False), "main")
    else:
        play = form.button("play-laws", "▶ Play", Play(True) if on else OpenClip(CLIP_KEY, play=True), "main")
    time = form.field("time", amount(present_time(state)), "Time in seconds", lambda text: _to_time(text, end, on))
    bar = f'<div class="bar kit-clock">{play}<label>t = {time} <i>of {amount(end, "s")}</i></label></div>'
    return bar + race_markup(state)


def _to_time(text: str, end: float, on: bool) -> tuple[Command, ...]:
    try:
        time = evaluate(text.strip().replace("−", "-").replace(",", "."))
    except InputError:
        raise InputError(f"t: expected seconds, got {text.strip()[:40]!r}") from None
    if not 0.0 <= time <= end:
        raise InputError(f"t: expected 0 to {amount(end, 's')}, got {amount(time)}")
    return (Seek(time),) if on else (OpenClip(CLIP_KEY), Seek(time))


PANEL = Panel((Laws, Timeline), build, rebuilds=())
