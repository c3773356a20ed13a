"""The list of runs: method, parameters, and how each has ended."""

from __future__ import annotations

from functools import cache

from armlab.benches.iterate.runs.commands import (
    AddRun,
    ChooseMethod,
    RemoveRun,
    SelectRun,
    SetParameter,
)
from armlab.benches.iterate.runs.state import Iterations, questions, vector_of
from armlab.benches.iterate.runs.ui.words import lowered_index, outcome, parameter_unit, sigma_unit
from armlab.benches.iterate.runs.worked import MOST_RUNS, Run, methods
from armlab.kin.ik.iterate import Parameter
from armlab.session.state import Command, State
from armlab.ui.colours import RUN_COLOURS, css
from armlab.ui.fields import Fields
from armlab.ui.format import capitalised, dot, escaped, trimmed
from armlab.ui.markup import button, options, select
from armlab.ui.tried import plain_number
from armlab.ui.units import units_of


def runs_markup(fields: Fields, state: State) -> str:
    """Return all runs, and a button for one more."""
    part, channel = state[Iterations], fields.channel_id
    runs = "".join(_run(fields, state, i, run) for i, run in enumerate(part.runs))
    full = len(part.runs) == MOST_RUNS
    hint = f"At most {MOST_RUNS} runs" if full else "One more run from the same start"
    more = button(channel, "add-run", "+ Run", "chip", hint, off=full)
    return f'<h3>Runs<span class="copies">{more}</span></h3>{runs}'


def _run(fields: Fields, state: State, i: int, run: Run) -> str:
    part, channel, units = state[Iterations], fields.channel_id, units_of(state)
    film = part.films.get(run.colour)
    stale = film is None or film.question != state.derived(questions)[i]
    film_of_this = i == part.selected
    mark = f"{dot(css(RUN_COLOURS[run.colour]))}{i + 1}"
    full, last = len(part.runs) == MOST_RUNS, len(part.runs) == 1
    head = button(
        channel, f"select-{i}", mark, "chip", "Play this run, and show its numbers", pressed=film_of_this
    ) + select(channel, f"method-{i}", f"Method of run {i + 1}", _methods(run.method))
    tools = button(channel, f"copy-{i}", "copy", "chip", "Copy this run", f"Copy run {i + 1}", off=full) + button(
        channel, f"remove-{i}", "✕", "chip", "Remove this run", f"Remove run {i + 1}", off=last
    )
    metres, freedom = sigma_unit(state), vector_of(state).m
    cells = "".join(
        _parameter(fields, i, parameter, run.values[parameter.key], parameter_unit(parameter, metres, freedom))
        for parameter in run.kind.parameters
    )
    numbers = f'<div class="kit-numbers">{cells}</div>' if cells else ""
    said = '<p class="dim">…</p>' if stale or film is None else outcome(film, units)
    top = f'<div class="kit-head">{head}</div><span class="it-tools">{tools}</span>'
    return f'<div class="it-run">{top}{numbers}{said}</div>'


@cache
def _methods(chosen: str) -> str:
    return options({key: capitalised(method.title) for key, method in methods().items()}, chosen)


def _parameter(fields: Fields, i: int, parameter: Parameter, value: float, unit: str) -> str:
    hint = f"{capitalised(parameter.title)}: {parameter.low:g} to {parameter.high:g}{f' {unit}' if unit else ''}"
    cell = fields.field(f"p{i}-{parameter.key}", trimmed(value, 6), f"{parameter.title} of run {i + 1}")
    return f'<label title="{escaped(hint)}"><span>{lowered_index(parameter.symbol)}</span>{cell}<i>{unit}</i></label>'


def run_command(cell: str, text: str) -> Command | None:
    """Return what a person asked for in the list of runs; None when no cell of it has this name.

    Raises
    ------
    InputError
        A parameter that is no number.
    """
    name, _, rest = cell.partition("-")
    if name == "add":
        return AddRun("dls_error")
    if name in ("select", "copy", "remove") and rest.isdecimal():
        i = int(rest)
        return {"select": SelectRun(i), "copy": AddRun(like=i), "remove": RemoveRun(i)}[name]
    if name == "method" and rest.isdecimal():
        return ChooseMethod(int(rest), text)
    if name[:1] == "p" and name[1:].isdecimal():
        return SetParameter(int(name[1:]), rest, plain_number(text))
    return None
