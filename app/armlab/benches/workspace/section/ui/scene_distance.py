"""A line from the tool, or from the target if it is elsewhere, to the nearest point of the workspace's boundary."""

from __future__ import annotations

import numpy as np
import viser

from armlab.benches.workspace.section.marks import target_measured, tool_measured
from armlab.benches.workspace.section.state import SectionView
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import Target
from armlab.session.state import State
from armlab.ui.colours import VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.units import units_of

THICKNESS = 0.004
DOT = 0.008
LEAST = 1e-3
"""Thickness of the line, diameter of the dot at its end, and the shortest line that is drawn, in sizes of the arm."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the line, a dot on the boundary and the distance."""
    line: viser.LineSegmentsHandle | None = None
    dot: viser.IcosphereHandle | None = None
    label: viser.LabelHandle | None = None
    shown = ""

    def show(state: State) -> None:
        nonlocal line, dot, label, shown
        measured = state.derived(target_measured) or state.derived(tool_measured)
        drawn = measured is not None and abs(measured.to.distance) > LEAST * canvas.size
        for node in (line, dot, label):
            if node is not None:
                seen(node, drawn)
        if measured is None or not drawn:
            return
        ends = np.stack([measured.point, measured.to.foot])
        points = ends[None].astype(np.float32)
        kind = "ok" if measured.to.distance > 0.0 else "no"
        text = units_of(state).length(abs(measured.to.distance))
        if line is None or dot is None or label is None:
            thickness = THICKNESS * canvas.size
            path = canvas.path("section_distance")
            line = canvas.scene.add_line_segments(f"{path}/line", points, VERDICT[kind], thickness=thickness)
            dot = canvas.scene.add_icosphere(
                f"{path}/foot",
                radius=DOT * canvas.size,
                color=VERDICT[kind],
                subdivisions=2,
                cast_shadow=False,
                receive_shadow=False,
            )
            label = canvas.scene.add_label(f"{path}/label", text, font_screen_scale=0.85, anchor="bottom-left")
            shown = kind
        if not np.array_equal(line.points, points):
            line.points = points
        if kind != shown:
            shown = kind
            line.colors = np.array(VERDICT[kind], dtype=np.uint8)
            dot.color = VERDICT[kind]
        move(dot, measured.to.foot)
        move(label, 0.5 * (ends[0] + ends[1]))
        write(label, text)

    return show


LAYER = Layer(
    "section_distance", order=82, watches=(SectionView, Joints, Target, Notation), build=build, panel="section"
)
