"""The solid arm: its bodies on the nodes of the canvas."""

from __future__ import annotations

from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach the bodies to the nodes."""
    bodies = [
        canvas.scene.add_glb(
            f"{canvas.node(i)}/body", glb, cast_shadow=True, receive_shadow=True, visible=not canvas.bare
        )
        for i, glb in enumerate(canvas.drawn.glbs)
        if glb is not None
    ]

    jumps = state[Target].jumps

    def show(state: State) -> None:
        nonlocal jumps
        jumped, jumps = state[Target].jumps != jumps, state[Target].jumps
        for body in bodies:
            if body.visible == canvas.bare:
                body.visible = not canvas.bare
        canvas.show_pose(state[Joints].q, at_once=state[Timeline].playing, slow=jumped)

    return show


LAYER = Layer("arm", order=10, watches=(Joints, Timeline), build=build, silent=True)
