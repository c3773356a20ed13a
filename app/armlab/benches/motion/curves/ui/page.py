"""Curves of one coordinate through typed knots: drawn together, measured, and with the equations behind them."""

from __future__ import annotations

from armlab.benches.motion.curves.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.curves.state import Curves
from armlab.benches.motion.curves.ui.facts import facts, fastest_markup, verdicts
from armlab.benches.motion.curves.ui.listed import curves_markup, knots_markup, limits_markup
from armlab.benches.motion.curves.ui.plots import Plots
from armlab.benches.motion.curves.ui.solved import rules_markup, solved_markup
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the knots, the curves, the plots and the tables."""
    as_text = False

    def turn() -> None:
        nonlocal as_text
        as_text = not as_text

    problem, knots = gui.form(post), gui.form(post)
    plots, curves, judged = Plots(gui, state), gui.form(post), gui.html()
    plots.derivatives()
    numbers = gui.html()
    with gui.fold("Limits and minimum time"):
        limits, fast = gui.form(post), gui.form(post)
    solved, rules = gui.html(), gui.form(post)

    def show(state: State) -> None:
        part = state[Curves]
        problem.show(examples(problem, EXAMPLES, part.example, ChooseExample))
        knots.show(knots_markup(knots, part, as_text, turn))
        curves.show(curves_markup(curves, part))
        limits.show(limits_markup(limits, part))
        judged.show(verdicts(part))
        plots.show(part)
        numbers.show(facts(part))
        fast.show(fastest_markup(fast, part))
        solved.show(solved_markup(part))
        rules.show(rules_markup(rules, part))

    return show


PANEL = Panel((Curves,), build, rebuilds=(Notation,), apart=True)
