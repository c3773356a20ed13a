"""The page of the incremental encoder: its tracks, its signals over time, and what each rule counts."""

from __future__ import annotations

import math
import re
from functools import partial

import numpy as np

from armlab.benches.sensor.absolute.ui.numbers import Grip, typed
from armlab.benches.sensor.absolute.ui.scene import HIDES
from armlab.benches.sensor.incremental.commands import BeginAgain, DragTo, SetMoves, StepQuarter
from armlab.benches.sensor.incremental.counting import Now, now
from armlab.benches.sensor.incremental.examples import EXAMPLES, ChooseIncrementalExample
from armlab.benches.sensor.incremental.state import CLIP_KEY, Incremental
from armlab.benches.sensor.incremental.ui.disk import strip, window_of
from armlab.benches.sensor.incremental.ui.signals import count_curve, large, signals
from armlab.benches.sensor.incremental.ui.words import (
    resolution_markup,
    rule_markup,
    rules_markup,
    state_markup,
    verdict,
)
from armlab.benches.sensor.stage import around
from armlab.session.amounts import amount
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE, GREY
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import readable, trimmed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.large import LargeChart
from armlab.ui.markup import row
from armlab.ui.option_text import DECIMALS
from armlab.ui.playing import play_button
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HEIGHT = 110

SUCH_AS = (math.pi / 2, -math.pi / 4, math.pi / 18)
"""Moves that a hint names, radians."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the fields, the tracks, the signals, the rules of counting, and the angle over time."""
    units = units_of(state)
    head, disk, rules = gui.form(post), gui.form(post), gui.form(post)
    chart = LargeChart(gui, "A, B and Z", "incremental_encoder")
    with gui.fold("Angle over time, direction and zero"):
        more, plot = gui.form(post), _Angles(gui, units)
    grip = Grip()

    def show(state: State) -> None:
        part, found = state[Incremental], state.derived(now)
        head.show(_head(head, part, found, units))
        disk.show(_disk(disk, state, found, grip, units))
        chart.show(part, partial(large, part))
        rules.show(
            tag("h3", "Signals ", tag("small", _time(part, found)), tag("span.copies", chart.button(rules))),
            signals(part, found),
            rules_markup(rules, part, found, units),
            verdict(part, found, units),
        )
        more.show(_more(more, part, found, units))
        plot.show(part, state[Timeline].clip == CLIP_KEY)

    return show


def _time(part: Incremental, found: Now) -> str:
    return f"at {amount(found.time)} of {amount(part.motion.duration, 's')}; triangles: counts up and down"


def _head(form: Form, part: Incremental, found: Now, units: Units) -> Markup:
    unit, such = units.angle_unit, " ".join(trimmed(angle / units.factor(True), 2) for angle in SUCH_AS)
    moves = form.field(
        "moves",
        "  ".join(readable(move / units.factor(True), DECIMALS) for move in part.moves),
        f"Moves in {unit}, one after the other",
        lambda text: SetMoves(read_moves(text, units)),
    )
    return joined(
        examples(form, EXAMPLES, part.example, ChooseIncrementalExample, said=units.said),
        row("PPR", tag("div.se-line", typed(form, part, "pulses", units), resolution_markup(part, found, units))),
        tag(
            "label.option.wide",
            tag("span", f"Moves, {unit}"),
            moves,
            title=f"Angles one after the other, such as {such}",
        ),
        row(
            "Speed",
            tag("div.se-line.in-speed", typed(form, part, "speed", units), tag("i", f"{unit}/s")),
            hint="Speed of all moves",
        ),
        row(
            "At the end",
            tag(
                "div.se-line.in-speed",
                typed(form, part, "shakes", units),
                "trembles of",
                typed(form, part, "shake", units),
                tag("i", f"{unit} of a period"),
            ),
            hint=f"The disk trembles to and fro, by an angle of which {units.turned_by(4)} are one period of A",
        ),
    )


def read_moves(text: str, units: Units) -> tuple[float, ...]:
    """Return typed moves in radians; `InputError` for one that is no number."""
    words = re.sub(r"\s+(deg|rad|°)", r"\1", text.replace(", ", " ").replace(";", " ")).split()
    return tuple(units.read(word, True, f"move {k}") for k, word in enumerate(words, 1))


def _disk(form: Form, state: State, found: Now, grip: Grip, units: Units) -> Markup:
    """Return the tracks under the sensors, which can be dragged, and the buttons that turn the disk."""
    part, window = state[Incremental], window_of(state[Incremental])

    def dragged(x: float, _: float, drag: int) -> DragTo:
        end = float(part.motion.angles[-1])
        moved = grip.moved(x, drag, end)
        return DragTo(grip.value - moved * window.span / window.part(), drag)

    quarter, end = units.turned_by(1), part.motion.duration
    hint = f"Turn the disk by {quarter} electrical"
    return joined(
        tag(
            "div.ab-hold",
            strip(part, found.angle),
            title="Drag to turn the disk",
            **form.place("disk", dragged, drag=True),
        ),
        tag(
            "div.bar.kit-clock",
            play_button(form, state, CLIP_KEY, "moves", off=end == 0.0),
            form.chip("back", f"−{quarter}", StepQuarter(-1), hint),
            form.chip("on", f"+{quarter}", StepQuarter(1), hint),
            form.chip(
                "again", "Begin here", BeginAgain(), "The count is 0 where the disk stands, and there are no moves"
            ),
        ),
    )


def _more(form: Form, part: Incremental, found: Now, units: Units) -> Markup:
    start = form.field(
        "start",
        units.entry(part.start, True, 2),
        f"Angle at the start in {units.angle_unit}",
        lambda text: Set(Incremental, "start", units.read(text, True, "start")),
    )
    zero = form.chip(
        "index",
        "Z sets the count to 0",
        Set(Incremental, "index", not part.index),
        "At the zero of the disk",
        part.index,
    )
    return joined(
        state_markup(part, found, units),
        row("Start", tag("div.se-line", start, tag("i", units.angle_unit), zero)),
        rule_markup(form, part),
    )


class _Angles:
    """The angle of the disk and the one that the count stands for, over time."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._units = units
        curves = [Curve(f"disk, {units.angle_unit}", GREY, 1.4), Curve(f"count · AR, {units.angle_unit}", BLUE)]
        self._plot = Plot(
            gui, f"Angle, {units.angle_unit}", "t, s", curves, "incremental_angle", height=HEIGHT, clip=CLIP_KEY
        )
        self._shown: Incremental | None = None

    def show(self, part: Incremental, on: bool) -> None:
        """Show the curves if they have changed, and the cursor while the film is open."""
        if part != self._shown:
            self._shown = part
            times, counts = count_curve(part)
            factor = self._units.factor(True)
            resolution = 2.0 * np.pi / (part.pulses * part.decoder_of(part.decoder).per_period)
            self._plot.show(times, [part.motion.at(times) / factor, counts * resolution / factor])
        self._plot.cursor(TIME if on else None)


PANEL = Panel((Incremental, Timeline), build, rebuilds=(Notation, RobotPart), hides=HIDES, around=around)
