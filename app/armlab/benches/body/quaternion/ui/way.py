"""Between two orientations: the ways compared, in words, numbers and a plot of their speed."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.body.forms.state import Body
from armlab.benches.body.quaternion.between import DURATION, film_share, kinds_of_ends, speeds, turned_in_all, ways_of
from armlab.benches.body.quaternion.state_view import WAY_KEY, WAYS, QuaternionView
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, VERMILLION, Rgb, css
from armlab.ui.form import Form
from armlab.ui.format import MINUS, dot, mathml, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.playing import clock
from armlab.ui.plot import Curve, Plot
from armlab.ui.tables import head_line, line
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

COLOURS: dict[str, Rgb] = {"slerp": BLUE, "line": GREEN, "euler": VERMILLION}

HEIGHT = 114

HALF = 1e-9
"""Scalar product of two unit quaternions below which they are half a turn apart."""

ALIKE = 1e-6
"""Difference of two turns, radians, up to which they are equal."""

NONE = "–"


def way_markup(form: Form, state: State) -> Inside:
    """Return the choice of the way, the clock, and what the ways turn through."""
    view = state[QuaternionView]
    ways = form.chips("way", WAYS, view.way, "How the body goes", partial(Set, QuaternionView, "way"))
    arcs = form.chips(
        "arc",
        {"short": "shorter", "long": "as typed"},
        "short" if view.shorter else "long",
        f"To q or {MINUS}q",
        lambda key: Set(QuaternionView, "shorter", key == "short"),
    )
    return (
        tag("div.eq.small", mathml(r"\mathrm{slerp}(p,q,s)=p\,(p^{-1}q)^s")),
        row("Way", ways),
        row(f"q or {MINUS}q", arcs),
        clock(form, state, WAY_KEY, DURATION, DURATION * film_share(state)),
        _table(state),
        _said(state),
    )


def _table(state: State) -> Markup:
    units, sequence = units_of(state), state[Body].axes.upper()
    _, found = speeds(state)
    rows = []
    for key, title in WAYS.items():
        name = joined(dot(css(COLOURS[key])), f"{title} {sequence}" if key == "euler" else title)
        turned = turned_in_all(state, key)
        if turned is None:
            rows.append(line(NONE, NONE, name=name))
            continue
        mean = max(turned, 1e-12)
        rows.append(line(units.angle(turned), number(float(found[key].max()) / mean, 2), name=name))
    return tag("table.kit-points.bo-angles", head_line(None, "turned in all", "fastest / mean"), rows)


def _said(state: State) -> Markup:
    found, view = state.derived(ways_of), state[QuaternionView]
    along = f"p·q = {number(found.along, 3)}"
    if found.missing:
        return verdict_box(
            "warn", f"{along}: the same orientation", tag("p", f"{found.missing} Slerp is a whole turn.")
        )
    if abs(found.along) < HALF:
        why = "Both ways are as short: q and its opposite are as near to p, and rounding decides between them."
        return verdict_box("warn", f"{along}: half a turn apart", tag("p", why))
    if found.along < 0.0 and view.shorter:
        return tag("p", f"{along} is negative, so the way leads to {MINUS}q, which is the same orientation and nearer.")
    if found.along < 0.0:
        return verdict_box("warn", f"{along} is negative: the long way round", tag("p", f"{MINUS}q would be nearer."))
    return tag("p.dim", f"{along}. {_compared(state)}")


def _compared(state: State) -> str:
    """Return how the ways differ where q is as near to p as its opposite is, or nearer."""
    least, angles = turned_in_all(state, "slerp") or 0.0, turned_in_all(state, "euler") or 0.0
    if angles <= ALIKE:
        return "Both orientations are the same, and nothing turns."
    one = "Slerp and lerp turn about one axis; lerp is faster in its middle."
    if angles <= least + ALIKE:
        return f"{one} Here the three angles turn about the same axis."
    return f"{one} Three angles turn further, about many axes."


class Speeds:
    """The size of omega along each way."""

    def __init__(self, gui: Gui, state: State) -> None:
        units = units_of(state)
        self._factor = units.factor(True)
        curves = [Curve(title, COLOURS[key]) for key, title in WAYS.items()]
        self._plot = Plot(gui, f"|ω| per unit of s, {units.angle_unit}", "s", curves, "speeds", height=HEIGHT)
        self._drawn: object = None

    def show(self, state: State, share: float, on: bool) -> None:
        """Show the curves, with the cursor at the present s, or nothing."""
        self._plot.visible(on)
        if not on:
            return
        ends = kinds_of_ends(state)
        if ends != self._drawn:
            self._drawn = ends
            s, found = speeds(state)
            gap = np.full(len(s), np.nan)
            self._plot.show(s, [found.get(key, gap) / self._factor for key in WAYS])
        self._plot.cursor(share)
