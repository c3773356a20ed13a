"""The page Compare designs: longer links or wider limits, both workspaces side by side, before the arm is changed."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.workspace.what_if.arm import NAMED, fields_of, span_of, turns, value_of
from armlab.benches.workspace.what_if.state import (
    ChooseQuantity,
    ForgetChanges,
    Suppose,
    TakeOver,
    WhatIf,
)
from armlab.benches.workspace.what_if.ui.picture import picture
from armlab.benches.workspace.what_if.ui.words import (
    changes_markup,
    figures_markup,
    legend_markup,
    name_of,
    verdict_markup,
    with_unit,
)
from armlab.content.table_cells import quarter_turn
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.sizes import ANGLES
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of a number, its slider, the changes, and their effect."""
    present, units = state, units_of(state)

    def slid(value: float) -> None:
        post(slid_to(present[WhatIf], value, units))

    choices = gui.form(post)
    slider = gui.slider("value", 0.0, 1.0, 0.1, 0.0, slid, None)
    exact, told = gui.form(post), gui.form(post)

    def show(state: State) -> None:
        nonlocal present
        part, before = state[WhatIf], present[WhatIf]
        if (part.row, part.field, part.changes) != (before.row, before.field, before.changes):
            exact.forgive()  # what was refused there was about something else
        present = state
        choices.show(choices_markup(choices, part, units))
        angle = turns(part.arm, part.row, part.field)
        label = f"{name_of(part.arm, part.row, part.field, units)} {units.unit(angle)}"
        low, high = (units.value(end, angle) for end in span_of(part.arm, part.other, part.row, part.field))
        slider.span(label, low, high, 10.0 ** -units.decimals(angle))
        slider.show(units.value(value_of(part.other, part.row, part.field), angle))
        exact.show(exact_markup(exact, part, units))
        told.show(told_markup(told, state, units))

    return show


def slid_to(part: WhatIf, shown: float, units: Units) -> Suppose:
    """Return the command of the slider at a number, which is rounded on screen.

    It stands for the real value, for quarter turns of an angle of the table, or for an end of the span where these look
    the same: a twist of 3.142 rad would leave no axes parallel.
    """
    row, field = part.row, part.field
    angle, real = turns(part.arm, row, field), value_of(part.arm, row, field)
    if shown == units.value(real, angle):
        return Suppose(row, field, real)
    low, high = span_of(part.arm, part.other, row, field)
    value = shown * units.factor(angle)
    if field in ANGLES:
        value = quarter_turn(value, 0.5 * 10.0 ** -units.decimals(True) * units.factor(True))
    return Suppose(row, field, min(max(value, low), high))


def choices_markup(form: Form, part: WhatIf, units: Units) -> Inside:
    """Return the rows of the table and the numbers of one of them."""
    arm = part.arm
    joints = {str(i): str(i + 1) if i < arm.n else "tool" for i in range(arm.n + 1)}
    numbers = {field: name_of(arm, part.row, field, units) for field in fields_of(arm, part.row)}
    rows = form.chips(
        "joint", joints, str(part.row), "Row of the table, or the tool in frame n", lambda i: ChooseQuantity(int(i))
    )
    each = form.chips(
        "field", numbers, part.field, "Lengths, twist, limits of the joint", partial(ChooseQuantity, part.row)
    )
    about = tag(
        "p.dim", "Try another value and see how the workspace changes. The arm stays as it is until you apply it."
    )
    return about, row("Joint", rows), row("Number", each)


def exact_markup(form: Form, part: WhatIf, units: Units) -> Markup:
    """Return the field of the selected number, and its value in the real arm."""
    angle = turns(part.arm, part.row, part.field)
    name = name_of(part.arm, part.row, part.field, units)
    thought = units.entry(value_of(part.other, part.row, part.field), angle)

    def typed(text: str) -> Suppose:
        return Suppose(part.row, part.field, units.read(text, angle, name))

    field = form.field("value", thought, f"{name}, {NAMED[part.field]}, in {units.unit(angle)}", typed)
    now = f"now {with_unit(value_of(part.arm, part.row, part.field), angle, units)}"
    return joined(tag("div.over-slider", field), row("", tag("span.dim", now), hint=capitalised(NAMED[part.field])))


def told_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the changes, the buttons for them, and the results."""
    part = state[WhatIf]
    hint = "Edit the table of the arm like this"
    take = form.button("take", "Apply", TakeOver(), "main", hint, off=not part.changes)
    forget = form.chip("forget", "Discard", ForgetChanges(), "The arm as it is", off=not part.changes)
    found = part.found
    known = None if found is None else (figures_markup(found, units), picture(found, units), legend_markup(found))
    return changes_markup(form, part, units), tag("div.bar", take, forget), verdict_markup(state), known


def _around(state: State) -> Points:
    """Return the points of both workspaces."""
    found = state[WhatIf].found
    if found is None:
        return NOTHING
    return np.concatenate([found.old.points, found.new.points]).astype(np.float64)


def _looks(state: State) -> bool:
    """Return whether there are workspaces: while a slider changes one, the eye stays."""
    return state[WhatIf].found is not None


PANEL = Panel((WhatIf,), build, rebuilds=(RobotPart, Notation), around=_around, looks=_looks)
