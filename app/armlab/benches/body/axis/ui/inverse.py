"""Axis and angle from R: arccos against atan2 with the digits they lose, and both solutions."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.body.axis.inverse import FINEST, Inverse, errors, inverse_of
from armlab.benches.body.axis.state import NEAR, Axis
from armlab.benches.body.forms.rotation import forms_of
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import BLUE, VERMILLION
from armlab.ui.form import Form
from armlab.ui.format import MINUS, components, mathml, number, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plot import Curve, Plot
from armlab.ui.tables import head_line, line
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

FLOOR = 1e-18
"""Smallest error that is drawn, radians."""

SMALL = 1e-4
"""Angle, radians, below which it is written with a power of ten."""

POINTS = 81
HEIGHT = 110

EQUATIONS = (
    ("arccos", r"\theta=\arccos\frac{\mathrm{tr}\,R-1}{2}"),
    ("atan2", r"\theta=\mathrm{atan2}(\pm|a|,\;\mathrm{tr}\,R-1)"),
)


def inverse_markup(state: State) -> Inside:
    """Return what both formulas find, and the solutions."""
    found = inverse_of(state)
    rows = [
        line(radians(value), scientific(abs(value - found.angle)), number(found.lost(value), 1), name=name)
        for name, value in (("arccos", found.arccos), ("atan2", found.atan2))
    ]
    return (
        tag("div.eq.small", mathml(EQUATIONS[0][1]), tag("br"), mathml(EQUATIONS[1][1])),
        tag(
            "p.dim",
            "a = (r₃₂ − r₂₃, r₁₃ − r₃₁, r₂₁ − r₁₂) = 2 r sin θ, what is skew in R."
            f"⟦ 3.66 prints ½ before the root and not before the cosine: that would give {radians(found.printed)}.⟧",
        ),
        tag("table.kit-points.bo-angles", head_line(None, "θ, rad", "error, rad", "digits lost"), rows),
        _solutions(found, state),
    )


def radians(value: float) -> str:
    """Return an angle in radians with ten digits; never minus zero."""
    return scientific(value, 9) if 0.0 < abs(value) < SMALL else f"{value + 0.0:.10g}".replace("-", MINUS)


def _solutions(found: Inverse, state: State) -> Markup:
    if found.still:
        return verdict_box(
            "warn",
            "θ = 0: r is not determined",
            tag(
                "p",
                "sin θ = 0, and r = a / (2 sin θ) is 0/0. Every unit vector is an axis, since R(0, r) = I for all of "
                "them⟦; the notes say that there is no solution⟧.",
            ),
        )
    units, axis = units_of(state), np.array(found.axis)
    rows = [
        line(f"{radians(sign * found.angle)} rad = {units.angle(sign * found.angle)}", components(sign * axis))
        for sign in (1.0, -1.0)
    ]
    table = tag("table.kit-points", head_line("θ", "r"), rows)
    if found.half:
        why = "Half a turn: sin θ = 0, and R = 2 r rᵀ − I gives r up to its sign: +180° and −180° about r are the same."
    else:
        why = "Two solutions, one for each sign of the root: the opposite turn about the opposite axis."
    return tag("div", tag("h3", "Both solutions"), table, tag("p.dim", why))


class Errors:
    """The errors of both formulas over the distance from 0 or from half a turn."""

    def __init__(self, gui: Gui, form: Form) -> None:
        self._form = form
        curves = [Curve("arccos", VERMILLION), Curve("atan2", BLUE)]
        self._plot = Plot(gui, "log₁₀ of the error, rad", "k", curves, "digits", height=HEIGHT)
        self._drawn: object = None

    def show(self, state: State, on: bool) -> None:
        """Show the curves for the present axis, or nothing."""
        self._plot.visible(on)
        self._form.show(_near(self._form, state) if on else None)
        if not on:
            return
        axis, near = state.derived(forms_of).axis, state[Axis].near
        drawn = (*axis.tolist(), near)
        if drawn != self._drawn:
            self._drawn = drawn
            powers = np.linspace(0.0, FINEST, POINTS)
            self._plot.show(powers, [np.log10(np.maximum(each, FLOOR)) for each in errors(axis, near, powers)])


def _near(form: Form, state: State) -> Markup:
    near = state[Axis].near
    chips = form.chips("near", NEAR, near, "Angles at which the formulas are compared", partial(Set, Axis, "near"))
    return row(f"θ = {'' if near == 'zero' else 'π − '}10⁻ᵏ", chips, wide=True)
