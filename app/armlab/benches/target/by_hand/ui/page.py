"""The closed form of an arm by hand: step by step with the present numbers, every branch chosen where it arises."""

from __future__ import annotations

import numpy as np

from armlab.benches.target.by_hand.state import ByHand, Sheet, sheet
from armlab.benches.target.by_hand.ui.card import end_card, shown_step, step_card
from armlab.benches.target.by_hand.ui.drawn import corners_of_shapes
from armlab.benches.target.by_hand.words import method_words
from armlab.benches.target.solutions.state import Solutions
from armlab.kin.ik.by_hand import method_of
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import subscripts
from armlab.ui.html import Markup, tag
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the head, which stays, and the steps, which follow the target."""
    units = units_of(state)
    words = method_words(state[Joints].arm)
    gui.html(tag("h3", words.title), tag("p", subscripts(words.why)))
    if method_of(state[Joints].arm) is None:
        form = gui.form(post)
        more = form.chip("solutions", "Solutions", lambda: gui.open_panel("solutions"), "Open the page Solutions")
        form.show(tag("p.dim", words.instead), tag("div.bar", more))
        return lambda state: None
    form = gui.form(post)

    def show(state: State) -> None:
        found = state.derived(sheet)
        if found is not None:
            form.show(sheet_markup(form, state, found, units))

    return show


def sheet_markup(form: Form, state: State, found: Sheet, units: Units) -> Markup:
    """Return all steps, and what they end in."""
    numbers = range(1, len(found.derivation.steps) + 1)
    return tag(
        "div.bh",
        tag("p.dim", _count(found, bool(any(state[Joints].locked)))),
        _walk(form, state, found),
        [step_card(form, state, found, k, units) for k in numbers],
        end_card(form, state, found, units),
    )


def _count(found: Sheet, held: bool) -> str:
    free = any(step.case == "any" for step in found.derivation.steps)
    many = "1 set" if found.count == 1 else f"{found.count} sets"
    said = f"The numbers follow the target; {many} of joint values."
    if not found.count:
        said = "The numbers follow the target. No branch leads to joint values."
    elif free:
        said = "The numbers follow the target. Where any value will do there are infinitely many solutions."
    return f"{said} Held joints are treated as free here." if held else said


def _walk(form: Form, state: State, found: Sheet) -> Markup:
    k, last = shown_step(state, found), len(found.derivation.steps)
    unfolded = state[ByHand].unfolded
    return tag(
        "div.bar.bh-walk",
        form.chip("back", "‹ Back", Set(ByHand, "shown", max(1, k - 1)), "The step before", off=k == 1),
        tag("span", f"Step {k} of {last}"),
        form.chip("next", "Next ›", Set(ByHand, "shown", min(last, k + 1)), "The step after", off=k == last),
        form.chip("unfold", "All steps", Set(ByHand, "unfolded", not unfolded), "Unfold all steps", unfolded),
    )


def around(state: State) -> Points:
    """Return the corners of what is drawn, which belong in the picture."""
    found = state.derived(sheet)
    if found is None or not found.derivation.steps:
        return NOTHING
    step = found.derivation.steps[shown_step(state, found) - 1]
    points = corners_of_shapes(step.shapes)
    base = state[Joints].arm.base
    return np.asarray(points @ base[:3, :3].T + base[:3, 3]) if len(points) else NOTHING


PANEL = Panel((Joints, Target, ByHand, Solutions), build, see_through=True, hides=("gap",), around=around)
