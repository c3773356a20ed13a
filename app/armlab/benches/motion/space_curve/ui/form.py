"""Inputs for a curve in space: kind, waypoints or formulas, options, law, marks in the scene."""

from __future__ import annotations

from functools import partial

from armlab.benches.motion.space_curve.commands import (
    AddPoint,
    ChooseCurve,
    ChooseLaw,
    LookAt,
    OwnTimes,
    RemovePoint,
    SetOption,
    SetPoint,
    TypeFormula,
)
from armlab.benches.motion.space_curve.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.space_curve.laid import FORMULA, kinds
from armlab.benches.motion.space_curve.stage import stage_of
from armlab.benches.motion.space_curve.state import CLIP_KEY, MOST_POINTS, SpaceCurve, curve_of
from armlab.benches.motion.space_curve.ui.words import corrected
from armlab.kin.motion import free_law_types
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, trimmed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale
from armlab.ui.playing import play_button
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, plain_number, units_of

VIEWS = {"curve": "Curve", "turn": "Orientation"}

LINE = r"p(s)=s\,p_b+(1-s)\,p_a"
"""Formula of the straight line between two points."""

OVERFLY = (
    "⟦Notes 6.118–6.119 want p̈ = 0 at both ends of the blend; with the constant p̈ of 6.120 it jumps there: "
    "corrected. "
    "In 6.121 the “+ c” is the velocity at 0 and belongs to 6.122.⟧"
)


def scales_of(units: Units) -> tuple[Scale, ...]:
    """Return the units on screen of the coordinates of a waypoint."""
    return (Scale(units.length_unit, units.factor(False)),) * 3


def head(form: Form, state: State) -> Markup:
    """Return the choice of curve or turn, the examples, and the button of the film."""
    part = state[SpaceCurve]
    view = form.chips("shown", VIEWS, part.shown, "What is shown", _looking)
    chooser = examples(form, EXAMPLES, part.example, ChooseExample, said=units_of(state).said)
    play = play_button(form, state, CLIP_KEY, "curve")
    return joined(chooser, tag("div.bar", play, tag("span.sc-view", view)))


def _looking(view: str) -> LookAt:
    return LookAt("turn" if view == "turn" else "curve")


def curve_form(form: Form, state: State) -> Markup:
    """Return the inputs for kind, waypoints or formulas, options and parameter of the curve."""
    part, units = state[SpaceCurve], units_of(state)
    kind = kinds()[part.curve.key]
    titles = {key: each.title for key, each in kinds().items()}
    chooser = form.select("curve", "Curve", titles, part.curve.key, ChooseCurve)
    typed = _formula(form, part) if part.curve.key == FORMULA else _points(form, part, units)
    given = option_form(form, "o-", kind.fields, part.curve.options, partial(SetOption, "curve"), scales_of(units))
    hint = "Parametrise the curve by its arc length⟦ (notes 6.13–6.17)⟧"
    cell, other = f"length {_turned(part.by_length)}", Set(SpaceCurve, "by_length", not part.by_length)
    by_length = form.chip(cell, "By arc length", other, hint, part.by_length)
    notes = corrected(OVERFLY) if part.curve.key == "overfly" else None
    formula = tag("div.eq.small", mathml(LINE)) if part.curve.key == "line" else None
    found = state.derived(curve_of)
    told = found.given.remarks_in(units.length_unit, units.factor(False))
    return joined(
        tag("h3", "Curve ", tag("span.copies", by_length)),
        tag("div.kit-head", chooser),
        typed,
        formula,
        tag("div.options.sc-options", given),
        notes,
        [tag("p.dim", text) for text in told],
    )


def _turned(on: bool) -> str:
    """Return the state to which a press of a button leads, which ends the name of its cell."""
    return "off" if on else "on"


def _formula(form: Form, part: SpaceCurve) -> Markup:
    rows = []
    for k, axis in enumerate("xyz"):
        typed = form.field(f"f {k}", part.formula[k], f"{axis} as a function of s", partial(TypeFormula, k))
        rows.append(tag("label", tag("span", f"{axis}(s) ="), typed, tag("i", "m")))
    return tag("div.kit-numbers.kit-typed.sc-typed", rows)


def _points(form: Form, part: SpaceCurve, units: Units) -> Markup:
    kind, count = kinds()[part.curve.key], len(part.points)
    fewest, counted = count <= kind.least, kind.most == kind.least
    rows = []
    for i, point in enumerate(part.points):
        cells = [_coordinate(form, part, units, i, j) for j in range(len(point))]
        hint, label = "Remove this waypoint", f"Remove waypoint {i + 1}"
        drop = None if counted else form.button(f"drop {i}", "✕", RemovePoint(i), "copy", hint, label, off=fewest)
        rows.append(line(*cells, drop, name=f"{i + 1}"))
    heads = head_line("", *(f"{axis}, {units.length_unit}" for axis in "xyz"), "")
    full = count >= (MOST_POINTS if kind.most is None else min(kind.most, MOST_POINTS))
    add = (
        None
        if counted
        else form.chip("add-point", "+ waypoint", AddPoint(), "Add a waypoint after the last one", off=full)
    )
    return joined(tag("table.kit-points", heads, rows), add)


def _coordinate(form: Form, part: SpaceCurve, units: Units, i: int, j: int) -> Markup:
    def typed(text: str) -> SetPoint:
        return SetPoint(i, j, units.read(text, False, f"waypoint {i + 1}, {'xyz'[j]}"))

    below = f"p {i + 1} {j}" if i + 1 < len(part.points) else ""
    label = f"Waypoint {i + 1}, {'xyz'[j]}"
    return form.field(f"p {i} {j}", units.entry(part.points[i][j], False), label, typed, below)


def law_form(form: Form, state: State) -> Markup:
    """Return the inputs for the law, its duration and its options."""
    part = state[SpaceCurve]
    titles = {key: kind.title for key, kind in free_law_types().items()}
    chooser = form.select("law", "Timing law", titles, part.law.key, ChooseLaw)
    seconds, hint = trimmed(part.duration, 4), "Duration in seconds"
    duration = form.field("T", seconds, hint, lambda text: Set(SpaceCurve, "duration", plain_number(text, "T")))
    found = state.derived(curve_of)
    own = None
    if part.shown == "curve" and found.given.duration is not None:
        same = part.law.key == "constant" and part.duration == found.given.duration
        hint = "Constant rate and the time of the waypoints: the motion for which the curve was made"
        own = form.chip("own-times", f"its own time, {found.given.duration:.4g} s", OwnTimes(), hint, same)
    kind = free_law_types()[part.law.key]
    given = option_form(form, "l-", kind.fields, part.law.options, partial(SetOption, "law"))
    return joined(
        tag("h3", "Timing law s(t)"),
        tag("div.kit-head", chooser, tag("label.sc-time", "T ", duration, tag("i", "s"))),
        own,
        tag("div.options.sc-options", given),
        [tag("p.dim", text) for text in found.law.remarks],
    )


def marks(form: Form, state: State) -> Markup:
    """Return the switches for the drawings of the curve in the scene, and their size."""
    part = state[SpaceCurve]
    frame = _mark(form, "frame", part.frame, "t, n, b", "The Frenet frame with the circle of curvature")
    arrows = _mark(form, "arrows", part.arrows, "ṗ, p̈", "Velocity, and the two parts of the acceleration")
    stage = state.derived(stage_of)
    scaled = None
    if stage.model:
        size = f"1 : {trimmed(stage.ratio, 1)}"
        said = f"The curve is far too large for the arm, so a model {size} of it is drawn beside the arm."
        scaled = tag("p.dim", said)
    return joined(tag("div.bar", tag("span.dim", "In the scene"), frame, arrows), scaled)


def _mark(form: Form, name: str, on: bool, text: str, hint: str) -> Markup:
    return form.chip(f"{name} {_turned(on)}", text, Set(SpaceCurve, name, not on), hint, on)
