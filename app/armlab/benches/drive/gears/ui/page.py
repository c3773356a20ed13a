"""The page of gears: a train of wheels, the best ratio for a load, and kinds of transmissions."""

from __future__ import annotations

from functools import partial

from armlab.benches.drive.gears.examples import EXAMPLES, ChooseGearExample
from armlab.benches.drive.gears.film import DURATION
from armlab.benches.drive.gears.stage import around
from armlab.benches.drive.gears.state import CLIP_KEY, SHOWN, Gears
from armlab.benches.drive.gears.ui.best import TorqueChart, best_markup
from armlab.benches.drive.gears.ui.kinds import kinds_markup
from armlab.benches.drive.gears.ui.train import train_markup
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Inside, tag
from armlab.ui.playing import clock
from armlab.ui.plugin import OF_THE_ARM, Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HIDES = (*OF_THE_ARM, "gizmo", "gap")
"""Layers in whose place the wheels are drawn."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the choice of what is shown, the film, and what is chosen."""
    head, film, form = gui.form(post), gui.form(post), gui.form(post)
    units, chart = units_of(state), TorqueChart(gui)

    def show(state: State) -> None:
        part = state[Gears]
        film.show(clock(film, state, CLIP_KEY, DURATION) if part.shown == "train" else None)
        if form.shows(part):
            return
        head.show(
            examples(head, EXAMPLES, part.example, ChooseGearExample),
            tag("div.cases", head.chips("shown", SHOWN, part.shown, "What is shown", partial(Set, Gears, "shown"))),
        )
        form.show(_markup(form, state, units, chart))

    return show


def _markup(form: Form, state: State, units: Units, chart: TorqueChart) -> Inside:
    part = state[Gears]
    if part.shown == "best":
        return best_markup(form, part, chart)
    return kinds_markup(form, part) if part.shown == "kinds" else train_markup(form, state, units)


PANEL = Panel((Gears, Timeline), build, rebuilds=(RobotPart, Notation), hides=HIDES, around=around)
