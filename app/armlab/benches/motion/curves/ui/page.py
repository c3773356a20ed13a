"""Curves of one coordinate through typed knots: drawn together, measured, and what is solved for them."""

from __future__ import annotations

from armlab.benches.motion.curves.commands import (
    AddCurve,
    AddKnot,
    ChooseLaw,
    ChoosePath,
    FindFastest,
    RemoveCurve,
    RemoveKnot,
    SetKnot,
    SetKnots,
    SetLimit,
    SetOption,
    SetUnit,
    ShowCurve,
    ShowDegree,
    TakeFastest,
)
from armlab.benches.motion.curves.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.curves.made import kinds
from armlab.benches.motion.curves.state import Curves
from armlab.benches.motion.curves.ui.facts import facts, fastest_markup, verdicts
from armlab.benches.motion.curves.ui.listed import curves_markup, knots_markup, limits_markup
from armlab.benches.motion.curves.ui.plots import Plots
from armlab.benches.motion.curves.ui.solved import rules_markup, solved_markup
from armlab.benches.motion.curves.ui.words import read, read_rows
from armlab.errors import InputError
from armlab.kin.motion.law_types import free_law_types
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.option_form import Scale, option_value
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import tried
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make knots, curves, plots and tables."""
    present, as_text = state, False

    def typed(fields: Fields, cell: str, text: str) -> None:
        nonlocal as_text
        if cell == "as-text":
            as_text = not as_text
            show(present)
        elif not tried(fields, cell, text, lambda: _commands(present, cell, text), present, post):
            show(present)

    problem = gui.fields(lambda cell, text: typed(problem, cell, text))
    knots = gui.fields(lambda cell, text: typed(knots, cell, text))
    curves = gui.fields(lambda cell, text: typed(curves, cell, text))
    limits = gui.fields(lambda cell, text: typed(limits, cell, text))
    plots, numbers = Plots(gui, state), gui.html()
    fast = gui.fields(lambda cell, text: typed(fast, cell, text))
    solved = gui.html()
    rules = gui.fields(lambda cell, text: typed(rules, cell, text))

    def show(state: State) -> None:
        nonlocal present
        present, part = state, state[Curves]
        problem.show(examples_markup(problem.channel_id, EXAMPLES, part.example))
        knots.show(knots_markup(knots, part, as_text))
        curves.show(curves_markup(curves, part))
        limits.show(limits_markup(limits, part) + verdicts(part))
        plots.show(part)
        numbers.show(facts(part))
        fast.show(fastest_markup(fast, part))
        solved.show(solved_markup(part))
        rules.show(rules_markup(rules, part))

    return show


def _commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for."""
    part, (name, _, rest) = state[Curves], cell.partition(" ")
    if name == "example":
        return (ChooseExample(text),) if text else ()
    if name == "rows":
        return (SetKnots(read_rows(text)),)
    if name in ("t", "q") and rest.isdecimal():
        return (SetKnot(int(rest), name, read(text, f"knot {int(rest) + 1}, {name}")),)
    if name == "add-knot" and rest.isdecimal():
        return (AddKnot(int(rest)),)
    if name == "remove-knot" and rest.isdecimal():
        return (RemoveKnot(int(rest)),)
    if name in ("v_max", "a_max"):
        value = read(text, name) if text.strip() else None
        return (SetLimit("v_max" if name == "v_max" else "a_max", value),)
    if name == "degree" and rest.isdecimal():
        return (ShowDegree(int(rest)),)
    simple = {"add-curve": AddCurve, "fastest": FindFastest, "take-fastest": TakeFastest}
    if name in simple:
        return (simple[name](),)
    if name == "unit":
        return (SetUnit(rest),)
    return _of_curve(part, cell, text)


def _of_curve(part: Curves, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for of one curve: its kind, its law, an option."""
    name, _, rest = cell.partition("-")
    if rest.isdecimal():
        i = int(rest)
        asked: dict[str, Command] = {
            "show": ShowCurve(i),
            "remove": RemoveCurve(i),
            "path": ChoosePath(i, text),
            "law": ChooseLaw(i, text),
        }
        return (asked[name],) if name in asked else ()
    name, _, option = cell.partition(" ")
    of, number = name[:-1].rstrip("0123456789"), name[-1:]
    if of not in ("path", "law") or not number.isdecimal() or int(number) >= len(part.curves):
        return ()
    drawn = part.curves[int(number)]
    chosen, kind = (
        (drawn.path, kinds()[drawn.path.key]) if of == "path" else (drawn.law, free_law_types()[drawn.law.key])
    )
    field = next((each for each in kind.fields if each.key == option), None)
    if field is None:
        raise InputError(f"option: {chosen.key} has none called {option[:40]!r}")
    value = option_value(field.seen(chosen.options), text, chosen.options.get(option), (Scale(part.unit),))
    return (SetOption(int(number), of, option, value),)


PANEL = Panel((Curves,), build, rebuilds=())
