"""The closed form of an arm by hand: every line of the derivation, with the present numbers and both signs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from armlab.benches.target.solutions.derivation import derivation, failing, method_words, ways_of
from armlab.kin.ik.closed_form import DerivationStep
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import Post, State
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui, Html

DECIMALS = 4
"""Number of decimals of numbers without a unit, and of areas."""

FEW, ACROSS = 2, 4
"""Number of values with room beside the name of a quantity, and in one line."""

SIGNS = {2: ("+", "−"), 4: ("+ +", "+ −", "− +", "− −")}
"""Heads of columns: the chosen signs, in the order of the lines."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build a formula for each line, which stays, and its numbers, which follow the target."""
    units, lines = units_of(state), state.derived(derivation)
    words = method_words(state[Joints].arm)
    gui.html(tag("h3", words.title), tag("p", words.why))
    if not lines:
        gui.html(tag("p.dim", words.instead))
        return lambda state: None
    card = gui.html()
    shown = [_Line(gui, k, line, units) for k, line in enumerate(lines, start=1)]

    def show(state: State) -> None:
        lines = state.derived(derivation)
        wrong = failing(lines)
        card.show(_card(wrong, bool(any(state[Joints].locked))))
        for k, (line, at) in enumerate(zip(shown, lines, strict=False)):
            line.show(at, wrong is not None and k == wrong, ways_of(state))

    return show


class _Line:
    """One line of the derivation."""

    def __init__(self, gui: Gui, number: int, line: DerivationStep, units: Units) -> None:
        formula = [tag("div", mathml(latex, True)) for latex in formulas(line.latex)]
        gui.html(tag("div.step", tag("h3", f"{number}. {line.title}"), tag("div.eq", formula)))
        self._numbers: Html = gui.html()
        self._units = units

    def show(self, line: DerivationStep, fails: bool, ways: int = 0) -> None:
        """Show the present numbers of the line.

        Parameters
        ----------
        line : DerivationStep
        fails : bool
            Whether no number of some quantity exists.
        ways : int
            In how many ways a wrist centre is placed: they have the columns then, and signs have lines. 0: for signs.
        """
        most = max((len(values) for values in line.numbers.values()), default=1)
        if ways and most > 1:
            most = ways
        signs = tuple(str(k + 1) for k in range(ways)) if ways and most > 1 else SIGNS.get(most, ())
        head = (tag("b"), [tag("i", sign) for sign in signs]) if signs else None
        sides = {
            name: (*values[0::2], *values[1::2]) if ways and len(values) == 2 * ways else values
            for name, values in line.numbers.items()
        }
        rows = [self._row(name, values, line.units.get(name, "")) for name, values in sides.items()]
        said = tag("p.no", "✕ This line has no real value: there is no solution.") if fails else None
        kind = "div.work.many" if most > FEW else "div.work"
        self._numbers.show(tag(kind, head, rows, style=f"--n:{min(most, ACROSS)}"), said)

    def _row(self, name: str, values: Sequence[float], unit: str) -> Inside:
        shown = {"rad": self._units.angle_unit, "m": self._units.length_unit}.get(unit, unit)
        cells = [tag("span", self._text(value, unit)) for value in values]
        return tag("b", mathml(name), (" ", tag("small", shown)) if shown else None), cells

    def _text(self, value: float, unit: str) -> Inside:
        if not math.isfinite(value):
            return tag("em.no", "none")
        if unit in ("rad", "m"):
            return self._units.text(value, unit == "rad")
        return number(value, DECIMALS)


def formulas(latex: str) -> list[str]:
    """Return the lines of a formula, in LaTeX that can be made MathML."""
    inside = latex.replace(r"\operatorname", r"\mathrm")
    for mark in (r"\begin{aligned}", r"\end{aligned}", "&"):
        inside = inside.replace(mark, "")
    return [part for row in inside.split("\\\\") for part in row.split(r",\quad")]


def _card(wrong: int | None, held: bool) -> Markup:
    """Return whether the target has solutions."""
    note = " Joints that are held are taken as free here." if held else ""
    if wrong is None:
        said = "The numbers follow the target. Columns are the choices there are, such as signs."
        return tag("p.dim", f"{said}{note}")
    return verdict_box("no", "No solution", f"Line {wrong + 1} fails.{note}")


PANEL = Panel((Joints, Target), build)
