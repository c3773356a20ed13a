"""Two bodies that turn by two time laws, each with the axis of its present angular velocity."""

from __future__ import annotations

from armlab.benches.body.forms.ui.pair import Pair, Shown
from armlab.benches.body.integral.film import Run, film_time, runs_of
from armlab.benches.body.integral.state import Integral
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import BLUE, VERMILLION, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import Units, units_of

COLOURS = (BLUE, VERMILLION)
"""Colours of the two laws."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both bodies."""
    pair = Pair(canvas, "integral", state)

    def show(state: State) -> None:
        time, units = film_time(state), units_of(state)
        one, other = (
            shown(run, time, f"law {k + 1}", colour, units)
            for k, (run, colour) in enumerate(zip(runs_of(state), COLOURS, strict=True))
        )
        pair.show(state, (one, other))

    return show


def shown(run: Run, time: float, name: str, colour: Rgb, units: Units) -> Shown:
    """Return the body of a law at a time."""
    rate = run.law[run.piece_at(time)].rate if time <= run.duration else 0.0
    about = f"ω: {units.text(rate, True)} {units.angle_unit}/s"
    return Shown(run.at(time), name, run.axis(time), run.turned(time), colour, about)


LAYER = Layer(
    "integral",
    order=70,
    watches=(Integral, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="integral",
)
