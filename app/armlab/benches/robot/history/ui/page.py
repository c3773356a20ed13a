"""The page of history: a timeline whose robots stand on the table at a press, what is a robot, and Asimov's laws."""

from __future__ import annotations

from armlab.benches.robot.history.examples import EXAMPLES, ChooseHistoryExample
from armlab.benches.robot.history.state import SHOWN, History
from armlab.benches.robot.history.ui.laws import laws_markup
from armlab.benches.robot.history.ui.things import things_markup
from armlab.benches.robot.history.ui.timeline import timeline_markup
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.html import tag
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

MARKUP = {"timeline": timeline_markup, "things": things_markup, "laws": laws_markup}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of what is shown, and that."""
    del state
    form = gui.form(post)

    def show(state: State) -> None:
        part = state[History]
        form.show(
            examples(form, EXAMPLES, part.example, ChooseHistoryExample),
            tag(
                "div.cases",
                form.chips("shown", SHOWN, part.shown, "What is shown", lambda key: Set(History, "shown", key)),
            ),
            MARKUP[part.shown](form, state),
        )

    return show


PANEL = Panel((History, RobotPart), build, rebuilds=(Notation,))
