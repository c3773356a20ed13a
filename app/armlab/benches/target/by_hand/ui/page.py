"""The closed form of an arm worked by hand: every line of the derivation, with the present numbers and both signs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from armlab.benches.target.solutions.derivation import derivation, failing, method_words, ways_of
from armlab.kin.ik.closed_form import DerivationStep
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import Post, State
from armlab.ui.format import escaped, mathml, number
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui, Html

DECIMALS = 4
"""Of numbers without a unit, and of areas."""

FEW, ACROSS = 2, 4
"""Values that have room beside the name of a quantity, and in one line."""

SIGNS = {2: ("+", "−"), 4: ("+ +", "+ −", "− +", "− −")}
"""Heads of columns: the signs that were chosen, in the order of the lines."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make a formula for each line, which stays, and its numbers, which follow the target."""
    units, lines = units_of(state), state.derived(derivation)
    words = method_words(state[Joints].arm)
    gui.html(f"<h3>{escaped(words.title)}</h3><p>{escaped(words.why)}</p>")
    if not lines:
        gui.html(f'<p class="dim">{escaped(words.instead)}</p>')
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
        formula = "".join(f"<div>{mathml(latex, True)}</div>" for latex in formulas(line.latex))
        gui.html(f'<div class="step"><h3>{number}. {escaped(line.title)}</h3><div class="eq">{formula}</div></div>')
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
        heads = "".join(f"<i>{sign}</i>" for sign in signs)
        head = f"<b></b>{heads}" if heads else ""
        sides = {
            name: (*values[0::2], *values[1::2]) if ways and len(values) == 2 * ways else values
            for name, values in line.numbers.items()
        }
        rows = "".join(self._row(name, values, line.units.get(name, "")) for name, values in sides.items())
        said = '<p class="no">✕ This line has no real value: there is no solution.</p>' if fails else ""
        kind = "work many" if most > FEW else "work"
        self._numbers.show(f'<div class="{kind}" style="--n:{min(most, ACROSS)}">{head}{rows}</div>{said}')

    def _row(self, name: str, values: Sequence[float], unit: str) -> str:
        shown = {"rad": self._units.angle_unit, "m": self._units.length_unit}.get(unit, unit)
        cells = "".join(f"<span>{self._text(value, unit)}</span>" for value in values)
        return f"<b>{mathml(name)}{f' <small>{escaped(shown)}</small>' if shown else ''}</b>{cells}"

    def _text(self, value: float, unit: str) -> str:
        if not math.isfinite(value):
            return '<em class="no">none</em>'
        if unit in ("rad", "m"):
            return self._units.text(value, unit == "rad")
        return number(value, DECIMALS)


def formulas(latex: str) -> list[str]:
    """Return the lines of a formula, in the LaTeX that can be made MathML."""
    inside = latex.replace(r"\operatorname", r"\mathrm")
    for mark in (r"\begin{aligned}", r"\end{aligned}", "&"):
        inside = inside.replace(mark, "")
    return [part for row in inside.split("\\\\") for part in row.split(r",\quad")]


def _card(wrong: int | None, held: bool) -> str:
    """Return whether the target has solutions."""
    note = " Joints that are held are taken as free here." if held else ""
    if wrong is None:
        return (
            f'<p class="dim">The numbers follow the target. Columns are the choices there are, such as signs.{note}</p>'
        )
    return f'<div class="verdict no"><b>✕ No solution</b>Line {wrong + 1} fails.{note}</div>'


PANEL = Panel((Joints, Target), build)
