"""The page of the absolute encoder: the disk under its sensors, the readings of both codes, and those of a turn."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.sensor.absolute.examples import EXAMPLES, ChooseAbsoluteExample
from armlab.benches.sensor.absolute.state import CLIP_KEY, Absolute
from armlab.benches.sensor.absolute.turning import DragTo, StepSectors, TurnTo
from armlab.benches.sensor.absolute.ui.numbers import Grip, typed
from armlab.benches.sensor.absolute.ui.scene import HIDES
from armlab.benches.sensor.absolute.ui.strip import strip, window_of
from armlab.benches.sensor.absolute.ui.words import neighbours_markup, readings_markup, verdict
from armlab.benches.sensor.stage import around
from armlab.kin.sensors.absolute import CODES
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE, VERMILLION
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import capitalised, mathml
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.playing import play_button
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.tray_picture import thinned
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

COLOURS = {"binary": VERMILLION, "gray": BLUE}
"""Colours of the curves, by code; Gray code lies above."""

POINTS = 180
"""Number of points of each curve from which on only its ends and extremes in short pieces are drawn."""

HEIGHT = 120


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the fields, the disk under the sensors, the readings, and the plot of a turn."""
    units = units_of(state)
    head, disk, said = gui.form(post), gui.form(post), gui.html()
    plot = _Readings(gui, units)
    with gui.fold("Words of the neighbouring sectors"):
        words = gui.html()
    grip = Grip()

    def show(state: State) -> None:
        part = state[Absolute]
        head.show(_head(head, part, units))
        disk.show(_disk(disk, state, grip, units))
        said.show(readings_markup(part, units), verdict(part, units))
        plot.show(part)
        words.show(neighbours_markup(part))

    return show


def _head(form: Form, part: Absolute, units: Units) -> Markup:
    tracks = {str(k): str(k) for k in range(1, part.tracks + 1)}
    chosen = form.select(
        "track",
        "Track of the sensor that is out of line",
        tracks,
        str(part.off_track),
        lambda key: Set(Absolute, "track", int(key)),
    )
    codes = {code: capitalised(name) for code, name in CODES.items()}
    return joined(
        examples(form, EXAMPLES, part.example, ChooseAbsoluteExample, said=units.said),
        row("Code", form.chips("code", codes, part.code, "Code of the disk", partial(Set, Absolute, "code"))),
        row("Tracks", tag("div.se-line", typed(form, part, "tracks", units), _resolution(part, units))),
        row(
            "Sensor",
            tag("div.se-line", "of track ", chosen, " ahead by ", typed(form, part, "offset", units), " sectors"),
            hint="The sensor that is out of line",
        ),
    )


def _resolution(part: Absolute, units: Units) -> Markup:
    count = 2**part.tracks
    turn = rf"\frac{{{units.turn_in_latex}}}{{2^{{{part.tracks}}}}}"
    width = units.constant(part.disk.width, True, 3)
    return tag("span.ab-width", mathml(turn), f" = {width}, {count} sectors", title="Width of a sector⟦; notes 2.40⟧")


def _disk(form: Form, state: State, grip: Grip, units: Units) -> Markup:
    """Return the tracks under the sensors, which can be dragged, and the angle of the disk."""
    part = state[Absolute]
    window = window_of(part.disk)

    def dragged(x: float, _: float, drag: int) -> DragTo:
        moved = grip.moved(x, drag, part.angle)
        return DragTo(grip.value - moved * window.span / window.part(), drag)

    typed = form.field(
        "angle",
        units.entry(part.angle, True, 2),
        f"Angle of the disk in {units.angle_unit}",
        lambda text: TurnTo(units.read(text, True, "θ")),
    )
    hint = "Turn the disk by a sector"
    return joined(
        tag("div.ab-hold", strip(part), title="Drag to turn the disk", **form.place("disk", dragged, drag=True)),
        tag(
            "div.bar.kit-clock",
            play_button(form, state, CLIP_KEY, "turn", "Turn"),
            form.chip("back", "−1", StepSectors(-1), hint),
            form.chip("on", "+1", StepSectors(1), hint),
            tag("label", "θ = ", typed, " ", tag("i", units.angle_unit)),
        ),
    )


class _Readings:
    """The position that is read over one turn, in both codes."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._unit, self._factor = units.angle_unit, units.factor(True)
        curves = [Curve(f"{capitalised(CODES[code])}, {self._unit}", colour) for code, colour in COLOURS.items()]
        self._plot = Plot(
            gui, f"Position that is read, {self._unit}", f"θ, {self._unit}", curves, "absolute_encoder", height=HEIGHT
        )
        self._drawn: object = None

    def show(self, part: Absolute) -> None:
        """Show the readings of the sensors as they are, and the cursor at the present angle."""
        drawn = (part.tracks, part.off_track, part.offset)
        if drawn != self._drawn:
            self._drawn = drawn
            edges = next(iter(part.disks.values())).pieces.edges
            x = np.repeat(edges, 2)[1:-1] / self._factor
            disks = [part.disks[code] for code in COLOURS]
            read = [np.repeat(disk.pieces.read * disk.width, 2) / self._factor for disk in disks]
            number = np.arange(len(x), dtype=float)
            kept = np.unique(np.concatenate([thinned(number, each, POINTS)[0] for each in read])).astype(int)
            self._plot.show(x[kept], [each[kept] for each in read])
        self._plot.cursor(part.angle / self._factor)


PANEL = Panel((Absolute, Timeline), build, rebuilds=(Notation, RobotPart), hides=HIDES, around=around)
