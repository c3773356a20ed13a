"""The page of coils in a magnetic field: forces, torque over a turn with and without a commutator, and its ripple."""

from __future__ import annotations

from armlab.benches.drive.stage import around
from armlab.benches.drive.torque.examples import EXAMPLES, ChooseTorqueExample
from armlab.benches.drive.torque.state import CLIP_KEY, Torque
from armlab.benches.drive.torque.ui.form import form_markup
from armlab.benches.drive.torque.ui.model import HALF
from armlab.benches.drive.torque.ui.numbers import check_markup, model_words, now_markup, turn_markup
from armlab.benches.drive.torque.ui.plots import Plots
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.markup import fold
from armlab.ui.playing import clock
from armlab.ui.plugin import OF_THE_ARM, Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

HIDES = (*OF_THE_ARM, "gizmo", "gap")
"""Layers in whose place the model is drawn."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields, the film, the plots and the numbers."""
    units = units_of(state)
    head, timing = gui.form(post), gui.form(post)
    plots, told = Plots(gui, units), gui.html()

    def show(state: State) -> None:
        part = state[Torque]
        if not head.shows(part):
            head.show(
                examples(head, EXAMPLES, part.example, ChooseTorqueExample),
                form_markup(head, part, units),
            )
        timing.show(clock(timing, state, CLIP_KEY, part.end))
        plots.show(state)
        told.show(
            turn_markup(state),
            now_markup(state),
            check_markup(state),
            fold("What the model leaves out", model_words()),
        )

    return show


PANEL = Panel((Torque, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=lambda state: around(state, HALF))
