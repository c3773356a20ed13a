"""The page of axis and angle: R in three steps, its eigenvalues, and the way back to axis and angle."""

from __future__ import annotations

from functools import partial

from armlab.benches.body.axis.examples import EXAMPLES, ChooseAxisExample, example_of
from armlab.benches.body.axis.state import CLIP_KEY, SHOWN, Axis, ShowStep
from armlab.benches.body.axis.ui.direct import steps_markup
from armlab.benches.body.axis.ui.eigen import eigen_markup
from armlab.benches.body.axis.ui.inverse import Errors, inverse_markup
from armlab.benches.body.forms.stage import around_both
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.numbers import axis_markup
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.forms.ui.steps import steps_bar
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.html import tag
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

MARKUP = {"steps": steps_markup, "eigen": eigen_markup, "inverse": inverse_markup}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build axis and angle, the choice of what is shown, its numbers and the plot."""
    form, numbers, near = gui.form(post), gui.html(), gui.form(post)
    errors = Errors(gui, near)

    def show(state: State) -> None:
        shown = state[Axis].shown
        form.show(
            examples(form, EXAMPLES, example_of(state), ChooseAxisExample),
            axis_markup(form, state),
            tag("div.cases", form.chips("shown", SHOWN, shown, "What is shown", partial(Set, Axis, "shown"))),
            steps_bar(form, state, CLIP_KEY, "step", ShowStep) if shown == "steps" else None,
        )
        numbers.show(MARKUP[shown](state))
        errors.show(state, shown == "inverse")

    return show


PANEL = Panel((Body, Axis, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=around_both)
