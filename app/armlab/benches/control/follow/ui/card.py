"""The list of runs, and the table of their results."""

from __future__ import annotations

import math
from collections.abc import Callable

from armlab.benches.control.follow.chosen import MOST_RUNS, Setup
from armlab.benches.control.follow.commands import AddRun, NameRun, RemoveRun, SelectRun
from armlab.benches.control.follow.examples import NAMES
from armlab.benches.control.follow.runs import Figures, Outcome, Peak
from armlab.benches.control.follow.state import Control, questions
from armlab.benches.control.follow.ui.form import sigma_unit
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import RUN_COLOURS, css
from armlab.ui.form import Form
from armlab.ui.format import dot, number, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

SMALL = 5e-3
"""Number, in the unit on screen, below which a power of ten is written."""

ROUNDING = 1e-9
"""Error or speed, in m or rad, also per second, below which it comes from rounding, not from the law."""

ZERO = tag("span.zero", "0")

Row = tuple[Inside, list[Inside]]


def runs_markup(form: Form, state: State) -> Markup:
    """Return the list of runs, and the button that adds one."""
    part = state[Control]
    full = len(part.runs) == MOST_RUNS
    rows = [_run(form, part, i, run, units_of(state)) for i, run in enumerate(part.runs)]
    hint = f"At most {MOST_RUNS} runs" if full else "Keep this run for comparison, and change a copy of it"
    more = form.button("add", "+ Run", AddRun(), "chip", hint, off=full)
    return joined(tag("h3", "Runs", tag("span.copies", more)), tag("div.ct-runs", rows))


def _run(form: Form, part: Control, i: int, run: Setup, units: Units) -> Markup:
    mark = dot(css(RUN_COLOURS[run.colour])), tag("span", _title(run, units))
    hint, selected = "Show and play this run", i == part.selected
    chosen = form.button(f"select {i}", mark, SelectRun(i), "chip", hint, f"Run {i + 1}", pressed=selected)
    away = None
    if len(part.runs) > 1:
        away = form.button(f"remove {i}", "✕", RemoveRun(i), "chip", "Remove this run", f"Remove run {i + 1}")
    return tag("div.ct-run", chosen, away)


def name_markup(form: Form, state: State) -> Markup:
    """Return the field for the name of the selected run; what a person has not called it stands in it, not typed."""
    part = state[Control]
    run, called = part.run, _title(part.run, units_of(state))
    typed = "" if run.name in NAMES else run.name
    name = form.field("name", typed, "Name of the run", NameRun, placeholder=called)
    return tag("label.option.wide.ct-name", tag("span", f"Run {part.selected + 1}"), name)


def _title(run: Setup, units: Units) -> str:
    """Return what a run is called: the name that an example gave it, in the units of the student, or else its own."""
    return units.said(run.title) if run.name in NAMES else run.title


def card_markup(state: State) -> Markup:
    """Return the results side by side, and the reasons of runs that stopped early."""
    units, found = units_of(state), _all_current(state)
    if not any(found):
        return tag("p.dim", "The runs are being computed …")
    said = [_said(i, each, units) for i, each in enumerate(found)]
    return joined(_table(state, _rows(state, _figures(found), units)), said)


def speeds_markup(state: State) -> Markup:
    """Return the largest speed of each joint, side by side."""
    return _table(state, _speeds(state, _figures(_all_current(state)), units_of(state)))


def _table(state: State, rows: list[Row]) -> Markup:
    heads = [(dot(css(RUN_COLOURS[run.colour])), str(i + 1)) for i, run in enumerate(state[Control].runs)]
    return tag("table.ct-card", head_line(None, *heads), [line(name, *values) for name, values in rows])


def _all_current(state: State) -> list[Outcome | None]:
    return [_current(state, i) for i in range(len(state[Control].runs))]


def _figures(found: list[Outcome | None]) -> list[Figures | None]:
    return [None if each is None else each.figures for each in found]


def _current(state: State, i: int) -> Outcome | None:
    """Return the result of a run, or None while it is being made."""
    part = state[Control]
    outcome = part.outcomes.get(part.runs[i].colour)
    return outcome if outcome is not None and outcome.question == state.derived(questions)[i] else None


def _said(i: int, outcome: Outcome | None, units: Units) -> Inside:
    if outcome is None:
        return None
    if outcome.run is None:
        return verdict_box("no", f"Run {i + 1} cannot be made", outcome.refused)
    said = []
    if outcome.run.stopped:
        text = f"Run {i + 1} ends at {number(outcome.run.duration, 2)} s"
        said.append(verdict_box("warn", text, f"{outcome.run.stopped}.", sign="!"))
    if outcome.figures is not None and outcome.figures.left_range is not None:
        said.append(_left(i, outcome, *outcome.figures.left_range, units))
    return said


def _left(i: int, outcome: Outcome, joint: int, time: float, units: Units) -> Markup:
    """Return a sentence that a joint leaves its range: a run does not keep joint limits."""
    arm = outcome.question.arm
    turns = bool(arm.revolute[joint])
    low, high = (units.text(float(limit), turns) for limit in arm.limits[joint])
    where = f"{low} to {high} {units.unit(turns)}"
    head = f"Run {i + 1} leaves the range of joint {joint + 1} at {number(time, 2)} s"
    return verdict_box("warn", head, f"A real arm would stop there: {where}.", sign="!")


def _speeds(state: State, figures: list[Figures | None], units: Units) -> list[Row]:
    arm = state[Joints].arm
    rows: list[Row] = []
    for i in range(arm.n):
        revolute = bool(arm.revolute[i])
        name = "peak q̇", tag("sub", str(i + 1)), f", {units.unit(revolute)}/s"
        fastest = [None if each is None else each.speeds[i] for each in figures]
        rows.append((name, ["…" if peak is None else _peak(peak, revolute, units) for peak in fastest]))
    return rows


def _rows(state: State, figures: list[Figures | None], units: Units) -> list[Row]:
    arm = state[Joints].arm
    rows: list[Row] = []
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
            ("smallest ", with_indices("σ_min"), f", {sigma}" if sigma else None),
            [_cell(each, lambda f: _sigma(f.sigma_min)) for each in figures],
        )
    )
    if any(each is not None and each.saturated > 0.0 for each in figures):
        rows.append(("saturated, s", [_cell(each, lambda f: number(f.saturated, 3)) for each in figures]))
    rows.append(("steps", [_cell(each, lambda f: str(f.steps)) for each in figures]))
    return rows


def _cell(figures: Figures | None, text: Callable[[Figures], Inside]) -> Inside:
    return "…" if figures is None else text(figures)


def _peak(peak: Peak, revolute: bool, units: Units) -> Inside:
    """Return a largest value with its time below it."""
    text = small(peak.value, revolute, units)
    return text if text == ZERO else (text, " ", tag("small", f"{number(peak.time, 2)} s"))


def _sigma(peak: Peak) -> Inside:
    return number(peak.value, 3), " ", tag("small", f"{number(peak.time, 2)} s")


def small(value: float, revolute: bool, units: Units) -> Inside:
    """Return an error or a speed, not negative, without its unit, as a power of ten if it is very small."""
    if value < ROUNDING:
        return ZERO
    shown = value / units.factor(revolute)
    if not math.isfinite(shown):
        return "–"
    if shown < SMALL:
        return scientific(shown, 0)
    return number(shown, max(units.decimals(revolute), 1 if shown >= 10.0 else 2))
