"""Two bodies, one turned about an axis in three steps and one at once."""

from __future__ import annotations

from armlab.benches.body.axis.film import Steps, film_time, steps_of
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.timing import DURATION, step_at
from armlab.benches.body.forms.ui.pair import Pair, Shown
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import ORANGE, PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import Units, units_of

NAMES = ("step 1: Cᵀ", "step 2: about z", "step 3: C")


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both bodies."""
    pair = Pair(canvas, "axis", state)

    def show(state: State) -> None:
        pair.show(state, shown(steps_of(state), film_time(state), units_of(state)))

    return show


def shown(steps: Steps, time: float, units: Units) -> tuple[Shown, Shown]:
    """Return the body that makes the steps, and the one that is turned at once, each with r."""
    turned = steps.turned(time)
    about = f"r: {units.angle(turned)}"
    name = "in three steps" if time in (0.0, DURATION) else NAMES[step_at(time)]
    return (
        Shown(steps.at(time), name, steps.carried(time), turned, PURPLE, about),
        Shown(steps.direct(time), "at once", steps.r, turned, ORANGE, about),
    )


LAYER = Layer(
    "axis",
    order=71,
    watches=(Body, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="axis",
)
