"""The verdict on robot B, its solutions as a table, and the matrices of the exercise in numbers."""

from __future__ import annotations

from armlab.benches.frames.chain.ui.symbols import transform_name
from armlab.benches.frames.two.reach import SAME, Meeting, Way, meeting_of, shown_way
from armlab.benches.frames.two.state import ELBOWS, TwoRobots
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import matrix, number, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, verdict_box
from armlab.ui.small_numbers import small, with_unit
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

COUNTED = ("No solution", "One solution", "Two solutions")

NOTES = (
    "⟦3.127 prints 1 for the place of the base in the middle matrix; it is (1, 2, 0), as in the right one. 3.132 asks "
    "two joints for position and angle, and links of 1 m, which alone give 3.128, do not reach: the two solutions that "
    "the notes announce are those of three links.⟧"
)


MORE = 3
"""Decimals of the length of a link beyond those of other lengths: typed as it is told, the tool is met to `SAME`."""


def verdict(state: State) -> Markup:
    """Return how many solutions there are, and why."""
    found, units = state.derived(meeting_of), units_of(state)
    if len(found.solutions) > len(COUNTED) - 1:
        return verdict_box("warn", "Infinitely many solutions", tag("p", found.sentence))
    if found.solutions:
        return verdict_box("ok", COUNTED[len(found.solutions)], tag("p", _why_some(found)))
    return verdict_box("no", COUNTED[0], tag("p", _why_none(found, units)), _only(found, units))


def _why_some(found: Meeting) -> str:
    if found.joints == 3:
        return "Three joints, and three numbers to reach: x, y and the angle of the tool."
    if found.needs_angle and found.distance < SAME:
        return "The tool has to be on the base: equal links are folded there, and joint 1 gives it any angle."
    if found.needs_angle:
        return "Two joints, and three numbers to reach: it is the length of the links that makes it possible."
    return "Two joints, and two numbers to reach: x and y. The angle of the tool comes out as it may."


def _why_none(found: Meeting, units: Units) -> str:
    if found.asked > found.reach:
        what = "the tool" if found.joints == 2 else "the axis of joint 3"
        return (
            f"Two links of {units.length(found.link)} bridge {units.length(found.reach)}, and {what} would have to be "
            f"{units.length(found.asked)} from the base: {units.length(found.asked - found.reach)} too far."
        )
    if found.joints == 2 and found.needs_angle:
        least = min((abs(way.turned_off) for way in found.ways), default=0.0)
        return (
            "Two joints reach the position, but these are three numbers: x, y and the angle. The tool of B misses the "
            f"angle by at least {with_unit(least, True, units)}."
        )
    return found.sentence


def _only(found: Meeting, units: Units) -> Markup | None:
    """Return how long two links would have to be for the whole pose, if it is asked of them."""
    only = found.only_link if found.joints == 2 and found.needs_angle else None
    return None if only is None else tag("p", f"Equal links would have to be {units.constant(only, False, MORE)} long.")


def solutions_markup(form: Form, state: State) -> Inside:
    """Return the table of solutions; the name of one lets B stand in it."""
    found, units = state.derived(meeting_of), units_of(state)
    if not found.ways or len(found.ways) > len(ELBOWS):
        return None
    shown = state.derived(shown_way)
    heads = [subscript("q", k + 1) for k in range(found.joints)]
    rows = [_row(form, state, way, way is shown, units) for way in found.ways]
    return tag("table.kit-points", head_line(units.angle_unit, *heads, "misses"), rows)


def _row(form: Form, state: State, way: Way, shown: bool, units: Units) -> Markup:
    key = next((key for key in ELBOWS if way.name.endswith(key)), "")
    name = form.chip(
        f"elbow {key}", way.name, Set(TwoRobots, "elbow", key) if key else (), "Let robot B stand so", shown
    )
    missed = "–" if abs(way.turned_off) < SAME else small(way.turned_off, True, units)
    return line(
        *[number(value, units.decimals(True) + 2) for value in (way.q / units.factor(True)).tolist()], missed, name=name
    )


def numbers_markup(state: State) -> Markup:
    """Return the matrices of the exercise, folded."""
    found = state.derived(meeting_of)
    named = (
        ("w", "A", found.T_wa),
        ("A", "EA", found.T_a_ea),
        ("EA", "EB", found.T_ea_eb),
        ("w", "EB", found.T_w_eb),
        ("w", "B", found.T_wb),
    )
    factors = [tag("div.fr-factor", tag("small", transform_name(i, j)), matrix(T, 3, 3)) for i, j, T in named]
    return fold("Matrices in numbers", tag("div.fr-pair", factors), tag("p.dim", NOTES))
