"""The velocity loop of one mass: block diagram, velocities over time, and the frequency response."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from armlab.benches.control.loop.examples import EXAMPLES, ChooseLoopExample
from armlab.benches.control.loop.state import CLIP_KEY, KINDS, Loop, present_time
from armlab.benches.control.loop.ui.large import Responses
from armlab.benches.control.loop.ui.pictures import ERROR, REACHED, WISH, bode, diagram
from armlab.session.amounts import amount
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import GREY
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, number, pairs
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.option_form import option_form
from armlab.ui.playing import clock
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.symbols import with_symbol
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

VELOCITIES, ERRORS = "v_d,\\;v", "e=v_d-v"
RESPONSE = r"W(s)=1/(\frac{M}{K}s+1)"
GAIN, PHASE, ERROR_GAIN = r"|W(j\omega)|", r"W(j\omega)", r"|1-W(j\omega)|"


FOLLOWS, FAILS = 0.05, 0.5
"""Ratio of lasting error to wish below which it is small, and from which on the loop does not follow."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the diagram, the numbers, the plots and the frequency response."""
    units = units_of(state)
    head, drawn, form, timing = gui.form(post), gui.html(), gui.form(post), gui.form(post)
    plots, verdict = _Plots(gui), gui.html()
    with gui.fold(("Frequency response ", mathml(RESPONSE))):
        heading, response, charts = gui.form(post), gui.html(), Responses(gui, units)

    def show(state: State) -> None:
        part = state[Loop]
        head.show(_head(head, part, units))
        drawn.show(diagram(part, present_time(state)))
        form.show(form_markup(form, part))
        timing.show(clock(timing, state, CLIP_KEY, part.end))
        plots.show(state)
        verdict.show(_verdict(part, units))
        charts.show(part)
        heading.show(tag("h3", tag("span.copies", charts.button(heading))))
        response.show(bode(part, units), _numbers(part, units))

    return show


class _Plots:
    """Velocities and error over time."""

    def __init__(self, gui: Gui) -> None:
        wish, v = Curve("v_d, m/s", WISH, dash=(6, 4)), Curve("v, m/s", REACHED)
        title = tag("span", mathml(VELOCITIES), " (dashed: wanted), m/s")
        self._v = Plot(gui, title, "t, s", [wish, v], "velocity", legend=False, clip=CLIP_KEY)
        lasting = [Curve(f"lasting amplitude {sign}, m/s", GREY, 1.2, dash=(3, 3)) for sign in ("above", "below")]
        name = tag("span", mathml(ERRORS), ", m/s (grey: what stays)")
        self._e = Plot(
            gui, name, "t, s", [Curve("e, m/s", ERROR), *lasting], "velocity_error", legend=False, clip=CLIP_KEY
        )
        self._shown: Loop | None = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed, and the cursor while the film is open."""
        part = state[Loop]
        if part != self._shown:
            self._shown = part
            t, wish = part.times, part.reference
            v = part.loop.velocity(t, wish, part.v0)
            self._v.show(t, [wish.at(t), v])
            level = np.full(len(t), part.loop.steady_error(wish))
            self._e.show(t, [wish.at(t) - v, level, -level])
        on = state[Timeline].clip == CLIP_KEY
        for plot in (self._v, self._e):
            plot.cursor(TIME if on else None)


def _written(says: str) -> Markup:
    return with_symbol(says, "v_d")


def _head(form: Form, part: Loop, units: Units) -> Markup:
    chooser = examples(form, EXAMPLES, part.example, ChooseLoopExample, written=_written, said=units.said)
    formula = mathml(r"M\,\dot v=F,\quad F=K\,(v_d-v)")
    title = "A mass without friction whose velocity is controlled by a force⟦; notes 7.3-7.10⟧"
    return joined(chooser, tag("div.eq.small", "\N{EM SPACE}", formula, title=title))


def form_markup(form: Form, part: Loop) -> Markup:
    """Return the choice of the wanted velocity, and the fields of the loop."""
    hint = "What velocity is wanted from t = 0 on"
    kinds = form.chips("kind", KINDS, part.kind, hint, partial(Set, Loop, "kind"))
    given = option_form(form, "l-", part.fields, part.values, partial(Set, Loop), needed=True)
    return joined(row("Wanted", kinds, wide=True), tag("div.options.loop-form", given))


def _verdict(part: Loop, units: Units) -> Markup:
    """Return the verdict on the lasting error, and its reason."""
    if part.kind == "step":
        loop = part.loop
        left = math.exp(-loop.cutoff * part.end)
        body = (
            f"The error falls to 37 % in each M/K = {amount(loop.time_constant, 's')}; after {amount(part.end, 's')} "
            f"{amount(100.0 * left)} % of the first one are left."
        )
        return verdict_box("ok", "The error dies out", body)
    share, error = float(part.loop.error_gain(part.omega)), part.loop.steady_error(part.reference)
    kind = "ok" if share < FOLLOWS else "warn" if share < FAILS else "no"
    head = f"Error that stays: {amount(error, 'm/s')}, {number(100.0 * share, 1)} % of v_d"
    phase = -float(part.loop.phase(part.omega))
    body = (
        f"v has {number(100.0 * float(part.loop.closed_gain(part.omega)), 1)} % of the amplitude of v_d and comes "
        f"{units.angle(phase)}, {amount(1e3 * phase / part.omega, 'ms')}, later."
    )
    return verdict_box(kind, _written(head), _written(body))


def _numbers(part: Loop, units: Units) -> Markup:
    loop = part.loop
    cutoff = f"{amount(loop.cutoff, 'rad/s')} = {amount(loop.cutoff / (2.0 * math.pi), 'Hz')}"
    rows: list[tuple[Inside, str]] = [
        (("Cutoff ", mathml("K/M")), cutoff),
        (("Time constant ", mathml("M/K")), amount(loop.time_constant, "s")),
    ]
    if part.kind == "sine":
        gain = float(loop.closed_gain(part.omega))
        rows += [
            (("Gain ", mathml(GAIN)), f"{number(gain, 3)} = {number(20.0 * math.log10(gain), 2)} dB"),
            (("Phase of ", mathml(PHASE)), units.angle(float(loop.phase(part.omega)))),
            (("Error gain ", mathml(ERROR_GAIN)), number(float(loop.error_gain(part.omega)), 3)),
        ]
    return pairs(rows)


PANEL = Panel((Loop, Timeline), build, rebuilds=(Notation,), apart=True)
