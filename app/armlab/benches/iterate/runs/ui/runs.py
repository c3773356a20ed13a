"""The list of runs: method, parameters, and the end of each."""

from __future__ import annotations

from functools import cache, partial

from armlab.benches.iterate.runs.commands import (
    AddRun,
    ChooseMethod,
    RemoveRun,
    SelectRun,
    SetParameter,
)
from armlab.benches.iterate.runs.state import Iterations, questions, vector_of
from armlab.benches.iterate.runs.ui.words import outcome, parameter_unit, sigma_unit
from armlab.benches.iterate.runs.worked import MOST_RUNS, Run, methods
from armlab.kin.ik.iterate import Parameter
from armlab.session.state import State
from armlab.ui.colours import RUN_COLOURS, css
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, trimmed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.symbols import with_indices
from armlab.ui.units import plain_number, units_of


def runs_markup(form: Form, state: State) -> Markup:
    """Return all runs, and a button that adds one."""
    part = state[Iterations]
    runs = [_run(form, state, i, run) for i, run in enumerate(part.runs)]
    full = len(part.runs) == MOST_RUNS
    hint = f"At most {MOST_RUNS} runs" if full else "Add a run from the same start"
    more = form.chip("add-run", "+ Run", AddRun("dls_error"), hint, off=full)
    return joined(tag("h3", "Runs", tag("span.copies", more)), runs)


def _run(form: Form, state: State, i: int, run: Run) -> Markup:
    part, units = state[Iterations], units_of(state)
    film = part.films.get(run.colour)
    stale = film is None or film.question != state.derived(questions)[i]
    mark = dot(css(RUN_COLOURS[run.colour])), str(i + 1)
    full, last = len(part.runs) == MOST_RUNS, len(part.runs) == 1
    hint = "Play this run, and show its numbers"
    head = tag(
        "div.kit-head",
        form.button(f"select-{i}", mark, SelectRun(i), "chip", hint, pressed=i == part.selected),
        form.select(f"method-{i}", f"Method of run {i + 1}", _methods(), run.method, partial(ChooseMethod, i)),
    )
    tools = tag(
        "span.it-tools",
        form.button(f"copy-{i}", "copy", AddRun(like=i), "chip", "Copy this run", f"Copy run {i + 1}", off=full),
        form.button(f"remove-{i}", "✕", RemoveRun(i), "chip", "Remove this run", f"Remove run {i + 1}", off=last),
    )
    metres, freedom = sigma_unit(state), vector_of(state).m
    cells = [
        _parameter(form, i, parameter, run.values[parameter.key], parameter_unit(parameter, metres, freedom))
        for parameter in run.kind.parameters
    ]
    numbers = tag("div.kit-numbers", cells) if cells else None
    said = tag("p.dim", "…") if stale or film is None else outcome(film, units)
    return tag("div.it-run", head, tools, numbers, said)


@cache
def _methods() -> dict[str, str]:
    return {key: capitalised(method.title) for key, method in methods().items()}


def _parameter(form: Form, i: int, parameter: Parameter, value: float, unit: str) -> Markup:
    def typed(text: str) -> SetParameter:
        return SetParameter(i, parameter.key, plain_number(text, f"{parameter.title} {parameter.symbol}"))

    hint = f"{capitalised(parameter.title)}: {parameter.low:g} to {parameter.high:g}{f' {unit}' if unit else ''}"
    cell = form.field(f"p{i}-{parameter.key}", trimmed(value, 6), f"{parameter.title} of run {i + 1}", typed)
    return tag("label", tag("span", with_indices(parameter.symbol)), cell, tag("i", unit), title=hint)
