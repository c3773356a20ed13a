"""The names q1 ... qn at the joints."""

from __future__ import annotations

from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui.canvas import Canvas
from armlab.ui.figure.housings import RADIUS
from armlab.ui.format import subscript
from armlab.ui.plugin import Layer, Show


def build(canvas: Canvas, state: State) -> Show:
    """Hang a label beside each joint; those of joints in one place are one label."""
    figure = canvas.drawn.figure
    anatomy = figure.anatomy
    labels = []
    for i, body in enumerate(anatomy.bodies):
        side = RADIUS * float(anatomy.radius[i]) * 1.25
        along = figure.housings[i] if body.revolute else 0.0
        on = i + 1 if body.revolute else i
        place = (0.0, 0.0, along) if body.revolute else tuple(body.mount[:3, 3])
        labels.append(
            canvas.scene.add_label(
                f"{canvas.node(on)}/name{i + 1}",
                subscript("q", i + 1),
                position=(place[0], place[1], place[2] + (side if not body.revolute else 0.0)),
                font_screen_scale=0.85,
                anchor="bottom-left",
                visible=False,
            )
        )

    def show(state: State) -> None:
        on = state[Display].names
        for label in labels:
            if label.visible != on:
                label.visible = on

    return show


LAYER = Layer("names", order=40, watches=(Display,), build=build)
