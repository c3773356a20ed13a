"""What is typed and chosen of a curve in space: kind, waypoints or formulas, options, law, marks in the scene."""

from __future__ import annotations

from armlab.benches.motion.space_curve.examples import EXAMPLES
from armlab.benches.motion.space_curve.laid import FORMULA, kinds
from armlab.benches.motion.space_curve.stage import stage_of
from armlab.benches.motion.space_curve.state import CLIP_KEY, MOST_POINTS, SpaceCurve, curve_of
from armlab.benches.motion.space_curve.ui.words import corrected
from armlab.kin.motion import free_law_types
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import escaped, trimmed
from armlab.ui.markup import button, chip, chips, options, select
from armlab.ui.option_form import Scale, option_markup
from armlab.ui.units import Units, units_of

VIEWS = {"curve": "Curve", "turn": "Orientation"}

OVERFLY = (
    "Notes 6.118–6.119 want p̈ = 0 at both ends of the blend; with the constant p̈ of 6.120 it jumps there: corrected. "
    "In 6.121 the “+ c” is the velocity at 0 and belongs to 6.122."
)


def scales_of(units: Units) -> tuple[Scale, ...]:
    """Return what stands on screen for the coordinates of a waypoint."""
    return (Scale(units.length_unit, units.factor(False)),) * 3


def head(fields: Fields, state: State) -> str:
    """Return the choice of curve or turn, the examples, and what plays."""
    part, channel = state[SpaceCurve], fields.channel_id
    view = chips(channel, {f"shown {key}": text for key, text in VIEWS.items()}, f"shown {part.shown}", "What is shown")
    examples = examples_markup(channel, EXAMPLES, part.example)
    playing = state[Timeline].clip == CLIP_KEY and state[Timeline].playing
    play = button(channel, *(("pause-curve", "❚❚ Pause") if playing else ("play-curve", "▶ Play")), "main")
    return f'{examples}<div class="bar">{play}<span class="sc-view">{view}</span></div>'


def curve_form(fields: Fields, state: State) -> str:
    """Return kind, waypoints or formulas, options and parameter of the curve."""
    part, channel, units = state[SpaceCurve], fields.channel_id, units_of(state)
    kind = kinds()[part.curve.key]
    titles = {key: each.title for key, each in kinds().items()}
    chooser = select(channel, "curve", "Curve", options(titles, part.curve.key))
    typed = _formula(fields, part) if part.curve.key == FORMULA else _points(fields, part, units)
    form = option_markup(fields, "o-", kind.fields, part.curve.options, scales_of(units))
    by_length = chip(
        channel,
        "length off" if part.by_length else "length on",
        "By arc length",
        "Parametrise the curve by the distance gone along it (notes 6.13–6.17)",
        part.by_length,
    )
    notes = corrected(OVERFLY) if part.curve.key == "overfly" else ""
    found = state.derived(curve_of)
    told = found.given.remarks_in(units.length_unit, units.factor(False))
    remarks = "".join(f'<p class="dim">{escaped(text)}</p>' for text in told)
    return (
        f'<h3>Curve <span class="copies">{by_length}</span></h3><div class="kit-head">{chooser}</div>{typed}'
        f'<div class="options sc-options">{form}</div>{notes}{remarks}'
    )


def _formula(fields: Fields, part: SpaceCurve) -> str:
    rows = "".join(
        f"<label><span>{axis}(s) =</span>{fields.field(f'f {k}', part.formula[k], f'{axis} as a function of s')}"
        "<i>m</i></label>"
        for k, axis in enumerate("xyz")
    )
    return f'<div class="kit-numbers kit-typed sc-typed">{rows}</div>'


def _points(fields: Fields, part: SpaceCurve, units: Units) -> str:
    kind, channel, count = kinds()[part.curve.key], fields.channel_id, len(part.points)
    fewest = count <= kind.least
    rows = []
    for i, point in enumerate(part.points):
        cells = "".join(f"<td>{_coordinate(fields, part, units, i, j)}</td>" for j in range(len(point)))
        drop = button(channel, f"drop {i}", "✕", "copy", "Remove this waypoint", f"Remove waypoint {i + 1}", off=fewest)
        rows.append(f"<tr><th>{i + 1}</th>{cells}<td>{'' if kind.most == kind.least else drop}</td></tr>")
    unit = units.length_unit
    heads = "".join(f"<th>{axis}, {unit}</th>" for axis in "xyz")
    full = count >= (MOST_POINTS if kind.most is None else min(kind.most, MOST_POINTS))
    add = (
        "" if kind.most == kind.least else chip(channel, "add-point", "+ waypoint", "Add one behind the last", off=full)
    )
    return f'<table class="kit-points"><tr><th></th>{heads}<th></th></tr>{"".join(rows)}</table>{add}'


def _coordinate(fields: Fields, part: SpaceCurve, units: Units, i: int, j: int) -> str:
    below = f"p {i + 1} {j}" if i + 1 < len(part.points) else ""
    label = f"Waypoint {i + 1}, {'xyz'[j]}"
    return fields.field(f"p {i} {j}", units.entry(part.points[i][j], False), label, below=below)


def law_form(fields: Fields, state: State) -> str:
    """Return law, duration and options of the law."""
    part, channel = state[SpaceCurve], fields.channel_id
    titles = {key: kind.title for key, kind in free_law_types().items()}
    chooser = select(channel, "law", "Timing law", options(titles, part.law.key))
    duration = fields.field("T", trimmed(part.duration, 4), "Duration in seconds")
    found = state.derived(curve_of)
    own = ""
    if part.shown == "curve" and found.given.duration is not None:
        same = part.law.key == "constant" and part.duration == found.given.duration
        hint = "Constant rate in the time of the waypoints: the motion the curve was made for"
        own = chip(channel, "own-times", f"its own {found.given.duration:.4g} s", hint, same)
    form = option_markup(fields, "l-", free_law_types()[part.law.key].fields, part.law.options)
    remarks = "".join(f'<p class="dim">{escaped(text)}</p>' for text in found.law.remarks)
    return (
        f'<h3>Timing law s(t)</h3><div class="kit-head">{chooser}'
        f'<label class="sc-time">T {duration}<i>s</i></label></div>'
        f'{own}<div class="options sc-options">{form}</div>{remarks}'
    )


def marks(fields: Fields, state: State) -> str:
    """Return what is drawn of the curve in the scene, and how large."""
    part, channel = state[SpaceCurve], fields.channel_id
    frame = chip(
        channel,
        f"frame {'off' if part.frame else 'on'}",
        "t, n, b",
        "The Frenet frame with the circle of curvature",
        part.frame,
    )
    arrows = chip(
        channel,
        f"arrows {'off' if part.arrows else 'on'}",
        "ṗ, p̈",
        "Velocity, and the two parts of the acceleration",
        part.arrows,
    )
    stage = state.derived(stage_of)
    scaled = (
        f'<p class="dim">Far beyond the arm: drawn as a model 1 : {trimmed(stage.ratio, 1)} beside it, with the '
        "axes at its origin.</p>"
        if stage.model
        else ""
    )
    return f'<div class="bar"><span class="dim">In the scene</span>{frame}{arrows}</div>{scaled}'
