"""The names q1 ... qn at the joints."""

from __future__ import annotations

from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.housings import RADIUS
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import Switch
from armlab.ui.units import units_of


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach a label to each joint; joints in one place share one."""
    figure = canvas.drawn.figure
    anatomy = figure.anatomy
    units = units_of(state)
    labels = []
    for i, body in enumerate(anatomy.bodies):
        side = RADIUS * float(anatomy.radius[i]) * 1.25
        along = figure.housings[i] if body.revolute else 0.0
        on = i + 1 if body.revolute else i
        place = (0.0, 0.0, along) if body.revolute else tuple(body.mount[:3, 3])
        labels.append(
            canvas.scene.add_label(
                f"{canvas.node(on)}/name{i + 1}",
                units.variable(i, body.revolute),
                position=(place[0], place[1], place[2] + (side if not body.revolute else 0.0)),
                font_screen_scale=0.85,
                anchor="bottom-left",
            )
        )

    def show(state: State) -> None:
        units = units_of(state)
        for i, (label, body) in enumerate(zip(labels, anatomy.bodies, strict=True)):
            if label.text != units.variable(i, body.revolute):
                label.text = units.variable(i, body.revolute)

    return show


SWITCH = Switch("names", "Joint names", "The names of the joint variables at the joints.", "N", default=True)
LAYER = Layer("names", order=40, watches=(Notation,), build=build, switch=SWITCH, silent=True)
