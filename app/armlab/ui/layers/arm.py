"""The arm itself: its bodies on the nodes of the canvas."""

from __future__ import annotations

from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.canvas import Canvas
from armlab.ui.plugin import Layer, Show


def build(canvas: Canvas, state: State) -> Show:
    """Hang the bodies on the nodes."""
    solid = not state[Display].skeleton
    bodies = [
        canvas.scene.add_glb(f"{canvas.node(i)}/body", glb, cast_shadow=True, receive_shadow=True, visible=solid)
        for i, glb in enumerate(canvas.drawn.glbs)
        if glb is not None
    ]

    def show(state: State) -> None:
        for body in bodies:
            if body.visible == state[Display].skeleton:
                body.visible = not state[Display].skeleton
        canvas.show_pose(state[Joints].q)

    return show


LAYER = Layer("arm", order=10, watches=(Joints, Display), build=build)
