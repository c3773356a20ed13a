"""The list of runs, and the table of what they have given."""

from __future__ import annotations

import math

from armlab.benches.control.follow.chosen import MOST_RUNS, Setup
from armlab.benches.control.follow.commands import AddRun, RemoveRun, SelectRun
from armlab.benches.control.follow.runs import Figures, Outcome, Peak
from armlab.benches.control.follow.state import Control, questions
from armlab.benches.control.follow.ui.form import sigma_unit
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import RUN_COLOURS, css
from armlab.ui.form import Form
from armlab.ui.format import dot, escaped, number, scientific
from armlab.ui.units import Units, units_of

SMALL = 5e-3
"""In the unit on screen; what is smaller than that and not nothing has a power of ten."""

ROUNDING = 1e-9
"""m or rad, and a second: what is smaller comes of rounding, not of the law."""

ZERO = '<span class="zero">0</span>'

Row = tuple[str, list[str]]


def runs_markup(form: Form, state: State) -> str:
    """Return all runs, a name for the selected one, and a button for one more."""
    part = state[Control]
    full = len(part.runs) == MOST_RUNS
    rows = "".join(_run(form, part, i, run) for i, run in enumerate(part.runs))
    hint = f"At most {MOST_RUNS} runs" if full else "Keep this run for comparison, and change a copy of it"
    more = form.button("add", "+ Run", AddRun(), "chip", hint, off=full)
    return f'<h3>Runs<span class="copies">{more}</span></h3><div class="ct-runs">{rows}</div>'


def _run(form: Form, part: Control, i: int, run: Setup) -> str:
    mark = f"{dot(css(RUN_COLOURS[run.colour]))}<span>{escaped(run.title)}</span>"
    hint, selected = "Show and play this run", i == part.selected
    chosen = form.button(f"select {i}", mark, SelectRun(i), "chip", hint, f"Run {i + 1}", pressed=selected)
    away = ""
    if len(part.runs) > 1:
        away = form.button(f"remove {i}", "✕", RemoveRun(i), "chip", "Remove this run", f"Remove run {i + 1}")
    return f'<div class="ct-run">{chosen}{away}</div>'


def card_markup(state: State) -> str:
    """Return the results side by side, and what there is to say about runs that did not come to their end."""
    part, units = state[Control], units_of(state)
    found = [_current(state, i) for i in range(len(part.runs))]
    heads = "".join(f"<th>{dot(css(RUN_COLOURS[run.colour]))}{i + 1}</th>" for i, run in enumerate(part.runs))
    rows = _rows(state, [None if each is None else each.figures for each in found], units)
    body = "".join(
        f"<tr><td>{name}</td>{''.join(f'<td>{value}</td>' for value in values)}</tr>" for name, values in rows
    )
    said = "".join(_said(i, each, units) for i, each in enumerate(found))
    return f'<table class="ct-card"><tr><th></th>{heads}</tr>{body}</table>{said}'


def _current(state: State, i: int) -> Outcome | None:
    """Return what a run has given; None while it is being made."""
    part = state[Control]
    outcome = part.outcomes.get(part.runs[i].colour)
    return outcome if outcome is not None and outcome.question == state.derived(questions)[i] else None


def _said(i: int, outcome: Outcome | None, units: Units) -> str:
    if outcome is None:
        return ""
    if outcome.run is None:
        return f'<div class="verdict no"><b>✕ Run {i + 1} cannot be made</b>{escaped(outcome.refused)}</div>'
    said = ""
    if outcome.run.stopped:
        text = f"Run {i + 1} ends at {number(outcome.run.duration, 2)} s"
        said = f'<div class="verdict warn"><b>! {text}</b>{escaped(outcome.run.stopped)}.</div>'
    if outcome.figures is not None and outcome.figures.left_range is not None:
        said += _left(i, outcome, *outcome.figures.left_range, units)
    return said


def _left(i: int, outcome: Outcome, joint: int, time: float, units: Units) -> str:
    """Return that a joint leaves its range: a run does not keep joint limits."""
    arm = outcome.question.arm
    turns = bool(arm.revolute[joint])
    low, high = (units.text(float(limit), turns) for limit in arm.limits[joint])
    where = f"{low} to {high} {units.unit(turns)}"
    return (
        f'<div class="verdict warn"><b>! Run {i + 1} leaves the range of joint {joint + 1} at {number(time, 2)} s</b>'
        f"A real arm would stop there: {where}.</div>"
    )


def _rows(state: State, figures: list[Figures | None], units: Units) -> list[Row]:
    arm = state[Joints].arm
    rows: list[Row] = []
    for i in range(arm.n):
        revolute = bool(arm.revolute[i])
        name = f"peak q̇{_index(i)}, {units.unit(revolute)}/s"
        rows.append((name, [_cell(each, lambda f, i=i, r=revolute: _peak(f.speeds[i], r, units)) for each in figures]))
    if arm.task.position:
        unit = units.length_unit
        rows.append(
            (f"largest error, {unit}", [_cell(each, lambda f: _peak(f.position, False, units)) for each in figures])
        )
        rows.append(
            (
                f"error at the end, {unit}",
                [_cell(each, lambda f: small(f.final_position, False, units)) for each in figures],
            )
        )
    if arm.task.rotation != "none":
        unit = units.angle_unit
        rows.append(
            (f"largest turn error, {unit}", [_cell(each, lambda f: _peak(f.rotation, True, units)) for each in figures])
        )
        rows.append(
            (
                f"turn error at the end, {unit}",
                [_cell(each, lambda f: small(f.final_rotation, True, units)) for each in figures],
            )
        )
    sigma = sigma_unit(arm)
    rows.append(
        (
            f"smallest σ_min{f', {sigma}' if sigma else ''}".replace("_min", "<sub>min</sub>"),
            [_cell(each, lambda f: _sigma(f.sigma_min)) for each in figures],
        )
    )
    if any(each is not None and each.saturated > 0.0 for each in figures):
        rows.append(("saturated, s", [_cell(each, lambda f: number(f.saturated, 3)) for each in figures]))
    rows.append(("steps", [_cell(each, lambda f: str(f.steps)) for each in figures]))
    return rows


def _cell(figures: Figures | None, text: object) -> str:
    return "…" if figures is None else text(figures)  # type: ignore[operator]


def _index(i: int) -> str:
    return f"<sub>{i + 1}</sub>"


def _peak(peak: Peak, revolute: bool, units: Units) -> str:
    """Return a largest value, and below it when."""
    text = small(peak.value, revolute, units)
    return text if text == ZERO else f"{text}<small>{number(peak.time, 2)} s</small>"


def _sigma(peak: Peak) -> str:
    return f"{number(peak.value, 3)}<small>{number(peak.time, 2)} s</small>"


def small(value: float, revolute: bool, units: Units) -> str:
    """Return an error or a speed, not negative, without its unit; a power of ten where it is very small."""
    if value < ROUNDING:
        return ZERO
    shown = value / units.factor(revolute)
    if not math.isfinite(shown):
        return "–"
    if shown < SMALL:
        return scientific(shown, 0)
    return number(shown, max(units.decimals(revolute), 1 if shown >= 10.0 else 2))
