"""The page of the speed from an encoder: both readings, their errors over the speed, and a run."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.sensor.absolute.ui.numbers import typed
from armlab.benches.sensor.speed.commands import SetCounts
from armlab.benches.sensor.speed.examples import EXAMPLES, ChooseSpeedExample
from armlab.benches.sensor.speed.state import EncoderSpeed
from armlab.benches.sensor.speed.ui.errors import COUNTS, TIME, errors, large
from armlab.benches.sensor.speed.ui.words import formulas, readings_markup, verdict
from armlab.errors import InputError
from armlab.kin.sensors.quadrature import HONEST
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.colours import GREY, css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import dot
from armlab.ui.html import Markup, joined, tag
from armlab.ui.large import LargeChart
from armlab.ui.markup import row
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, plain_number, units_of
from armlab.ui.widgets import Gui

RULES = {"x1": "×1", "x2": "×2", "x2_notes": "×2 A↑B↑", "x4": "×4"}
"""Rules of counting in few letters."""

POINTS, HEIGHT = 490, 120
"""Number of points of the curves of a run, and height of their plot in pixels."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the fields, both readings, their errors, and the run."""
    units = units_of(state)
    head, said, charts = gui.form(post), gui.html(), gui.form(post)
    chart = LargeChart(gui, "Largest error, log₁₀ of percent", "encoder_errors")
    plot = _Run(gui, units)

    def show(state: State) -> None:
        part = state[EncoderSpeed]
        head.show(_head(head, part, units))
        said.show(readings_markup(part, units), verdict(part, units))
        chart.show(part, partial(large, part, units), part.speed / units.factor(True))
        charts.show(
            tag("h3", "Largest error over the speed", tag("span.copies", chart.button(charts))),
            tag("div.legend", _name("by counts", css(COUNTS)), _name("by time between counts, dashed", css(TIME))),
            errors(part, units),
        )
        plot.show(part)

    return show


def _name(text: str, colour: str) -> Markup:
    return tag("span", dot(colour), text)


def _head(form: Form, part: EncoderSpeed, units: Units) -> Markup:
    unit = f"{units.angle_unit}/s"
    counts = form.field("counts", str(part.counts), "Counts in a window", lambda text: SetCounts(_whole(text)))
    rules = {key: RULES[key] for key in HONEST}
    return joined(
        examples(form, EXAMPLES, part.example, ChooseSpeedExample, said=units.said),
        formulas(units),
        row(
            "PPR",
            tag(
                "div.se-line",
                typed(form, part, "pulses", units),
                form.chips("decoder", rules, part.decoder, "Rule of counting", partial(Set, EncoderSpeed, "decoder")),
            ),
        ),
        row(
            "Window",
            tag(
                "div.se-line.sp-wide",
                typed(form, part, "window", units),
                tag("i", "s"),
                "clock",
                typed(form, part, "clock", units),
                tag("i", "Hz"),
            ),
        ),
        row(
            "Speed",
            tag("div.se-line.sp-wide", typed(form, part, "speed", units), tag("i", unit), "or C =", counts),
            hint="The true speed, or the counts that come in a window",
        ),
    )


def _whole(text: str) -> int:
    """Return a typed number of counts; `InputError` when it is not a positive whole one."""
    value = plain_number(text, "counts", "a whole number")
    if value < 1.0 or value != round(value):
        raise InputError(f"counts: expected a whole number of at least 1, got {text.strip()[:40]!r}")
    return round(value)


class _Run:
    """The true speed and both readings while the shaft speeds up, turns, and stops."""

    def __init__(self, gui: Gui, units: Units) -> None:
        unit, self._factor = f"{units.angle_unit}/s", units.factor(True)
        curves = [
            Curve(f"true, {unit}", GREY, 1.4),
            Curve(f"counts, {unit}", COUNTS),
            Curve(f"time, {unit}", TIME, dash=(6, 3)),
        ]
        title = f"Speeding up and stopping, {unit}"
        self._plot = Plot(gui, title, "t, s", curves, "encoder_speed", height=HEIGHT)
        self._shown: EncoderSpeed | None = None

    def show(self, part: EncoderSpeed) -> None:
        """Show the curves if they have changed."""
        if part == self._shown:
            return
        self._shown = part
        times = np.linspace(0.0, part.run.run.duration, POINTS)
        time = part.run.by_time(times)
        curves = part.run.run.speed_at(times), part.run.by_counts(times), np.where(np.isfinite(time), time, np.nan)
        self._plot.show(times, [curve / self._factor for curve in curves])


PANEL = Panel((EncoderSpeed,), build, rebuilds=(Notation,), apart=True)
