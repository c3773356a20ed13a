"""The page of power: the robot as a system, the chain of power, a load held still, and comparisons in numbers."""

from __future__ import annotations

from functools import partial

from armlab.benches.drive.power.examples import EXAMPLES, ChoosePowerExample
from armlab.benches.drive.power.state import SHOWN, Power
from armlab.benches.drive.power.ui.chain import choices_markup, table_markup
from armlab.benches.drive.power.ui.comparison import comparison_markup
from armlab.benches.drive.power.ui.holding import fields_markup, holding_markup, why_markup
from armlab.benches.drive.power.ui.sankey import sankey
from armlab.benches.drive.power.ui.system import robot_system, system_words
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Inside, tag
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the choice of what is shown, and that."""
    form, units = gui.form(post), units_of(state)

    def show(state: State) -> None:
        part = state[Power]
        if form.shows(part):
            return
        form.show(
            examples(form, EXAMPLES, part.example, ChoosePowerExample),
            tag("div.cases", form.chips("shown", SHOWN, part.shown, "What is shown", partial(Set, Power, "shown"))),
            _markup(form, part, units),
        )

    return show


def _markup(form: Form, part: Power, units: Units) -> Inside:
    if part.shown == "system":
        return robot_system(), system_words()
    if part.shown == "chain":
        return choices_markup(form, part), sankey(part.chain), table_markup(form, part)
    if part.shown == "hold":
        return fields_markup(form, part), holding_markup(part, units), why_markup()
    return comparison_markup(form, part)


PANEL = Panel((Power,), build, rebuilds=(Notation,), apart=True)
