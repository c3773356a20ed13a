"""Two bodies, one turned about moving axes and one about fixed axes."""

from __future__ import annotations

from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.timing import step_at
from armlab.benches.body.forms.ui.pair import Pair, Shown
from armlab.benches.body.forms.ui.rings import COLOURS
from armlab.benches.body.forms.ui.words import turn_names
from armlab.benches.body.sequence.film import Turns, turns_of
from armlab.benches.body.sequence.state import Sequence, film_time
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import Units, units_of


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both bodies."""
    pair = Pair(canvas, "sequence", state)

    def show(state: State) -> None:
        time, units = film_time(state), units_of(state)
        one, other = (shown(turns, time, units) for turns in turns_of(state))
        pair.show(state, (one, other))

    return show


def shown(turns: Turns, time: float, units: Units) -> Shown:
    """Return a body at a time, with the axis of its present turn."""
    k = step_at(time)
    angle = float(turns.angles_at(time)[k])
    about = f"{turn_names(turns.axes, turns.fixed)[k]}: {units.angle(angle)}"
    name = f"{'fixed' if turns.fixed else 'moving'} axes, turn {k + 1}"
    return Shown(turns.at(time), name, turns.axis(k), angle, COLOURS[turns.places[k]], about)


LAYER = Layer(
    "sequence",
    order=70,
    watches=(Body, Sequence, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="sequence",
)
