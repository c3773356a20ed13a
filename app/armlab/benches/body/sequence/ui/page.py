"""The page of two bodies: three turns about moving axes, and about fixed axes in reverse order, end alike."""

from __future__ import annotations

from functools import partial

from armlab.benches.body.forms.stage import around_both
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.numbers import angles_markup
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.forms.ui.steps import steps_bar
from armlab.benches.body.sequence.examples import EXAMPLES, ChooseSequenceExample, example_of
from armlab.benches.body.sequence.state import CLIP_KEY, ORDERS, Sequence, ShowTurn
from armlab.benches.body.sequence.ui.numbers import ends_markup, products_markup
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Markup
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the angles, the choice of the turn, the products of both bodies and the verdict."""
    form, numbers = gui.form(post), gui.html()

    def show(state: State) -> None:
        form.show(
            examples(form, EXAMPLES, example_of(state), ChooseSequenceExample, said=units_of(state).said),
            angles_markup(form, state, with_rings=False),
            _order(form, state),
            steps_bar(form, state, CLIP_KEY, "turn", ShowTurn),
        )
        numbers.show(products_markup(state), ends_markup(state))

    return show


def _order(form: Form, state: State) -> Markup:
    other = "moving" if state[Body].fixed else "fixed"
    chips = form.chips(
        "order", ORDERS, state[Sequence].order, "The turns of the other body", partial(Set, Sequence, "order")
    )
    return row(f"{other} axes".capitalize(), chips, wide=True)


PANEL = Panel((Body, Sequence, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=around_both)
