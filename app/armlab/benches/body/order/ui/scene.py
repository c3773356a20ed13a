"""Two bodies that make the same two rotations in opposite orders."""

from __future__ import annotations

from armlab.benches.body.forms.timing import step_at
from armlab.benches.body.forms.ui.pair import Pair, Shown
from armlab.benches.body.order import film
from armlab.benches.body.order.state import NAMES, Order, film_time
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import ORANGE, PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import Units, units_of

COLOURS = (PURPLE, ORANGE)
"""Colours of the two rotations."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both bodies."""
    pair = Pair(canvas, "order", state)

    def show(state: State) -> None:
        time, units = film_time(state), units_of(state)
        one, other = (shown(each, time, units) for each in film.pairs_of(state))
        pair.show(state, (one, other))

    return show


def shown(pair: film.Pair, time: float, units: Units) -> Shown:
    """Return a body at a time, with the axis of its present rotation."""
    k = step_at(time, 2)
    which, angle = pair.order[k], pair.angle(k, time)
    first, second = (NAMES[each] for each in pair.order)
    name = f"{first}, then {second}"
    return Shown(pair.at(time), name, pair.axis(k), angle, COLOURS[which], f"{NAMES[which]}: {units.angle(angle)}")


LAYER = Layer(
    "order",
    order=70,
    watches=(Order, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="order",
)
