"""Timing laws side by side: s and its derivatives, peaks and classes, time scaling, and bounds on a path."""

from __future__ import annotations

from armlab.benches.motion.laws.clip import present_time
from armlab.benches.motion.laws.commands import Stretch
from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.benches.motion.laws.ui.form import form_markup, head_markup, scaling_markup
from armlab.benches.motion.laws.ui.plots import Plots, race_markup
from armlab.benches.motion.laws.ui.signs import signs_markup
from armlab.benches.motion.laws.ui.tables import bounds_markup, stretch_markup, values_markup
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

SLOWEST, FASTEST, STEP = 5.0, 0.1, 0.005
"""Ends and step of the slider of k."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the form, the plots, the tables, the slider of k and the calculator."""
    head, bounds, form, timing = gui.form(post), gui.form(post), gui.form(post), gui.form(post)
    plots, values = Plots(gui), gui.html()
    with gui.fold("An acceleration of signs on intervals"):
        signs = gui.form(post)
    with gui.fold("Uniform time scaling r = k t"):
        scaling = gui.form(post)
        slider = gui.slider("k", FASTEST, SLOWEST, STEP, 1.0, lambda k: post(Stretch(k)), "New time over old time")
        after = gui.html()

    def show(state: State) -> None:
        part = state[Laws]
        head.show(head_markup(head, part))
        bounds.show(bounds_markup(bounds, part.bounded) if part.bounds_shown else None)
        form.show(form_markup(form, part))
        timing.show(clock(timing, state, CLIP_KEY, part.end), race_markup(state))
        plots.show(state)
        values.show(values_markup(part, present_time(state)))
        signs.show(signs_markup(signs, part))
        scaling.show(scaling_markup(scaling, part))
        slider.show(round(min(max(part.k, FASTEST), SLOWEST), 5))
        after.show(stretch_markup(part))

    return show


PANEL = Panel((Laws, Timeline), build, rebuilds=(Notation,), apart=True)
