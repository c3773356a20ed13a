"""The Frenet frame that moves along the path of the tool while the motion plays."""

from __future__ import annotations

from armlab.benches.motion.plan.frame import trihedron
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned
from armlab.benches.motion.space_curve.ui.frenet import FrenetFrame
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import Switch

LENGTH = 0.13
"""Length of the arrows, in sizes of the arm."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the frame."""
    frame = FrenetFrame(canvas, "motion/frame", LENGTH * canvas.size)

    def show(state: State) -> None:
        planned = last_planned(state) if state[Timeline].clip == CLIP_KEY else None
        found = None if planned is None else trihedron(planned, state[Timeline].time)
        if found is None:
            frame.hide()
        else:
            frame.show(*found)

    return show


SWITCH = Switch(
    "path_frame", "Path frame", "Tangent, normal, binormal and osculating circle of the path where the tool is"
)
LAYER = Layer("motion_frame", 89, (Plan, Timeline), build, switch=SWITCH)
