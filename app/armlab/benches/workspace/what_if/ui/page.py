"""What if a link were longer, or a limit wider: both workspaces side by side, before anything is changed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.workspace.what_if.arm import NAMED, fields_of, span_of, turns, value_of
from armlab.benches.workspace.what_if.state import ChooseQuantity, ForgetChanges, Suppose, TakeOver, WhatIf
from armlab.benches.workspace.what_if.ui.picture import picture
from armlab.benches.workspace.what_if.ui.words import (
    changes_markup,
    figures_markup,
    legend_markup,
    name_of,
    verdict_markup,
    with_unit,
)
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.format import capitalised, escaped
from armlab.ui.markup import button, chip, chips, row
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the choice of a number, its slider, the changes, and what they do."""
    present, units, drawn = state, units_of(state), False

    def typed(fields: Fields, cell: str, text: str) -> None:
        exact.forgive()
        if not tried(fields, cell, text, lambda: commands(present, cell, text, units), present, post):
            show(present)

    def slid(value: float) -> None:
        part = present[WhatIf]
        exact.forgive()
        post(Suppose(part.row, part.field, value * units.factor(turns(part.arm, part.row, part.field))))

    choices = gui.fields(lambda cell, text: typed(choices, cell, text))
    slider = gui.slider("value", 0.0, 1.0, 0.1, 0.0, slid, None)
    exact = gui.fields(lambda cell, text: typed(exact, cell, text))
    told = gui.fields(lambda cell, text: typed(told, cell, text))

    def show(state: State) -> None:
        nonlocal present, drawn
        present, part = state, state[WhatIf]
        if part.found is not None and not drawn:
            drawn = True
            gui.camera.keep_in_view()
        choices.show(_choices(choices.channel_id, part, units))
        angle, handle = turns(part.arm, part.row, part.field), slider.handle
        label = f"{name_of(part.arm, part.row, part.field, units)} {units.unit(angle)}"
        low, high = (units.value(end, angle) for end in span_of(part.arm, part.other, part.row, part.field))
        if (handle.label, handle.min, handle.max) != (label, low, high):
            handle.label, handle.min, handle.max, handle.step = label, low, high, 10.0 ** -units.decimals(angle)
        slider.show(units.value(value_of(part.other, part.row, part.field), angle))
        exact.show(_exact(exact, part, units))
        told.show(_told(told, state, units))

    return show


def _choices(channel: str, part: WhatIf, units: Units) -> str:
    """Return the rows of the table and the numbers of one of them."""
    arm = part.arm
    joints = {f"joint {i}": str(i + 1) if i < arm.n else "tool" for i in range(arm.n + 1)}
    numbers = {f"field {field}": name_of(arm, part.row, field, units) for field in fields_of(arm, part.row)}
    return (
        '<p class="dim">Change a number in thought and see what it does to the workspace.</p>'
        + row("Joint", chips(channel, joints, f"joint {part.row}", "Row of the table, or the tool in frame n"))
        + row("Number", chips(channel, numbers, f"field {part.field}", "Lengths, twist, limits of the joint"))
    )


def _exact(fields: Fields, part: WhatIf, units: Units) -> str:
    """Return the field of the number at hand, and what the number is of the arm as it is."""
    angle = turns(part.arm, part.row, part.field)
    name = name_of(part.arm, part.row, part.field, units)
    thought = units.entry(value_of(part.other, part.row, part.field), angle)
    field = fields.field("value", thought, f"{name}, {NAMED[part.field]}, in {units.unit(angle)}")
    now = f"now {with_unit(value_of(part.arm, part.row, part.field), angle, units)}"
    number = f'<label class="option wi-exact">{field}<i>{units.unit(angle)},</i></label>'
    return row(
        f"{escaped(name)} =", f'{number}<span class="dim">{escaped(now)}</span>', hint=capitalised(NAMED[part.field])
    )


def _told(fields: Fields, state: State, units: Units) -> str:
    """Return the changes, what can be done with them, and what is known."""
    part, channel = state[WhatIf], fields.channel_id
    take = button(channel, "take", "Take over", "main", "Edit the table of the arm like this", off=not part.changes)
    forget = chip(channel, "forget", "Forget all", "The arm as it is", off=not part.changes)
    found = part.found
    known = "" if found is None else figures_markup(found, units) + picture(found, units) + legend_markup(found)
    return (
        changes_markup(channel, part, units) + f'<div class="bar">{take}{forget}</div>' + verdict_markup(state) + known
    )


def commands(state: State, cell: str, text: str, units: Units) -> tuple[Command, ...]:
    """Return what a person asked for; none for what no page of ours sends.

    Raises
    ------
    InputError
        What was typed is no number; the text says which.
    """
    part, (what, _, rest) = state[WhatIf], cell.partition(" ")
    simple: dict[str, Callable[[], Command]] = {"take": TakeOver, "forget": ForgetChanges}
    if cell in simple:
        return (simple[cell](),)
    if cell == "value":
        angle = turns(part.arm, part.row, part.field)
        return (Suppose(part.row, part.field, units.read(text, angle, name_of(part.arm, part.row, part.field, units))),)
    if what == "field":
        return (ChooseQuantity(part.row, rest),)
    i, _, field = rest.partition(" ")
    if not i.isdecimal():
        return ()
    if what == "joint":
        return (ChooseQuantity(int(i)),)
    return (Suppose(int(i), field, value_of(part.arm, int(i), field)),) if what == "back" else ()


def _around(state: State) -> Points:
    """Return the corners of both workspaces."""
    found = state[WhatIf].found
    if found is None:
        return NOTHING
    points = np.concatenate([found.old.points, found.new.points]).astype(np.float64)
    return np.array([points.min(axis=0), points.max(axis=0)])


PANEL = Panel((WhatIf,), build, rebuilds=(RobotPart, Notation), around=_around)
