"""The page of spaces: those of the arm, a pendulum by two numbers or by one, and two arms of one r."""

from __future__ import annotations

from functools import partial

from armlab.benches.pose.spaces.examples import EXAMPLES, ChooseSpacesExample
from armlab.benches.pose.spaces.state import SHOWN, Spaces
from armlab.benches.pose.spaces.ui.arms import arms_markup
from armlab.benches.pose.spaces.ui.maps import maps_markup
from armlab.benches.pose.spaces.ui.stick import stick_markup
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.html import tag
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

MARKUP = {"maps": maps_markup, "stick": stick_markup, "arms": arms_markup}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of what is shown, and that."""
    del state
    form = gui.form(post)

    def show(state: State) -> None:
        part = state[Spaces]
        form.show(
            examples(form, EXAMPLES, part.example, ChooseSpacesExample),
            tag("div.cases", form.chips("shown", SHOWN, part.shown, "What is shown", partial(Set, Spaces, "shown"))),
            MARKUP[part.shown](form, state),
        )

    return show


PANEL = Panel((Spaces, Joints), build)
