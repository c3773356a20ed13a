"""Two bodies: one stands as q says, the other as the product p q says."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.pair import Pair, Shown
from armlab.benches.body.quaternion.film import present, present_turn, products, second
from armlab.benches.body.quaternion.state import Quaternions
from armlab.benches.body.quaternion.state_view import QuaternionView
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import ORANGE, PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import Units, units_of


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both bodies."""
    pair = Pair(canvas, "quaternion", state)

    def show(state: State) -> None:
        pair.visible(state[QuaternionView].shown != "way")
        pair.show(state, shown(state, units_of(state)))

    return show


def shown(state: State, units: Units) -> tuple[Shown, Shown]:
    """Return the body of q with its axis, and that of p q, whose axis p has turned along."""
    axis, angle = present_turn(state)
    one, other = (
        np.asarray(rotation_from_quaternion(q), dtype=np.float64) for q in (present(state), products(state)[0])
    )
    carried = np.asarray(rotation_from_quaternion(second(state)) @ axis, dtype=np.float64)
    about = f"r: {units.angle(angle)}"
    return Shown(one, "q", axis, angle, PURPLE, about), Shown(other, "p q", carried, angle, ORANGE, f"p {about}")


LAYER = Layer(
    "quaternion",
    order=72,
    watches=(Body, Quaternions, QuaternionView, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="quaternion",
)
