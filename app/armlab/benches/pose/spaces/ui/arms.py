"""A planar 3R by three numbers: the arms that have them, and how far their tools are apart."""

from __future__ import annotations

from functools import partial

from armlab.benches.pose.spaces.arms import (
    NO_ANGLE,
    SYMBOLS,
    GoToTwin,
    SetR,
    Twins,
    are_infinitely_many,
    misfit,
    r_apart,
    suited,
    tools_apart,
    twins_of,
)
from armlab.benches.pose.spaces.state import DESCRIBED, Spaces
from armlab.content.robots import catalogue
from armlab.kin.transforms import inverse
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import readable, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.small_numbers import with_unit
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

ONE_TOOL = 1e-9
"""Distance of two tools, metres, below which they are in one place: rounding."""


def arms_markup(form: Form, state: State) -> Inside:
    """Return r, the arms that have it, and what r says; or arms that can be described so."""
    why, part = misfit(state), state[Spaces]
    if why == NO_ANGLE:
        said = "φ is the angle of the tool's x axis about z of frame 0, but this axis is along z: take joint 3 and q₃."
        return _described(form, part), verdict_box("todo", "No angle φ", tag("p", said))
    if why:
        hint = "Put this arm on the table; undo brings the present one back"
        offers = [form.chip(f"arm {key}", catalogue()[key].name, ChooseRobot(key), hint) for key in suited()]
        return (
            verdict_box(
                "todo", "Not for this arm", tag("p", f"This view needs a planar arm with three joints: {why}.")
            ),
            tag("h3", "Choose such an arm"),
            tag("div.bar", offers),
        )
    units, twins = units_of(state), state.derived(twins_of)
    return (
        _described(form, part),
        tag("div.kit-numbers", [_field(form, part, twins, k, units) for k in range(3)]),
        _table(state, twins, units),
        _go(form, twins),
        _card(state, twins, units),
    )


def _described(form: Form, part: Spaces) -> Markup:
    chips = form.chips(
        "described", DESCRIBED, part.described, "Numbers that describe the arm", partial(Set, Spaces, "described")
    )
    return tag("div.bar", tag("span.dim", "r of"), chips)


def _field(form: Form, part: Spaces, twins: Twins, k: int, units: Units) -> Markup:
    symbol, turns = SYMBOLS[part.described][k], k == 2

    def typed(text: str) -> Command:
        return SetR(k, units.read(text, turns, symbol.replace("_", "")))

    shown = readable(float(twins.r[k]) / units.factor(turns), units.decimals(turns))
    field = form.field(f"r {k}", shown, symbol.replace("_", " "), typed)
    return tag("label", tag("span", with_indices(symbol)), field, tag("i", units.unit(turns)))


def _table(state: State, twins: Twins, units: Units) -> Markup:
    arm = state[Joints].arm
    heads = [f"{units.variable(i, True)}, {units.angle_unit}" for i in range(3)]
    rows = []
    for name, q in (("this arm", twins.q), *(("the other", each) for each in twins.others)):
        T = inverse(arm.base) @ arm.fk(q)
        tool = f"({units.text(float(T[0, 3]), False)}, {units.text(float(T[1, 3]), False)})"
        rows.append(line(*(units.text(float(value), True) for value in q), tool, name=name))
    return tag("table.kit-points.sp-arms", head_line(None, *heads, f"tool, {units.length_unit}"), rows)


def _go(form: Form, twins: Twins) -> Markup:
    off = not len(twins.others)
    return tag("div.bar", form.chip("twin", "Go to the other arm", GoToTwin(), "Same r, other joint values", off=off))


def _card(state: State, twins: Twins, units: Units) -> Markup:
    described, apart = state[Spaces].described, tools_apart(state)
    if are_infinitely_many(state):
        said = "Joint 3 lies on the axis of joint 1, which may then have any angle: a whole curve of arms has this r."
        return verdict_box("no", "Infinitely many arms", tag("p", said))
    if apart is None:
        return verdict_box(
            "warn", "One arm only", tag("p", "The links before are stretched or folded, and both arms are one.")
        )
    residual = r_apart(state[Joints].arm, twins, described)
    amount = f"{scientific(residual)} m or rad" if residual else "0"
    same = tag("p", f"No number of r differs by more than {amount}.")
    if apart[0] <= ONE_TOOL:
        said = (
            "The tool is at one place and points one way: r describes the task without doubt, in as many numbers as "
            "the task has. Which arm does it is a matter of the inverse kinematics."
        )
        return verdict_box("ok", "Two arms, one tool", same, tag("p", said))
    said = (
        f"The tools are {with_unit(apart[0], False, units)} and {with_unit(apart[1], True, units)} apart: one r, two "
        "poses of the tool. As a description of the task it is ambiguous."
    )
    return verdict_box("no", "Two arms, two tools", same, tag("p", said))
