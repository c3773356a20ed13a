"""The chosen rotation as one turn: its axis at the moved frame, and its angle."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.tool.state import Pair, PoseView, pair_at
from armlab.kin.rotations import axis_angle
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Sketch, Triad, across, arc
from armlab.ui.units import Units, units_of

LENGTH, RADIUS = 0.22, 0.085
"""Length of the axis, and radius of the arc of the angle, in sizes of the arm."""

LEAST = 1e-6
"""Least angle of a turn with an axis, radians."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the moved frame and the axis of its turn, which follow the arm."""
    frame, sketch = Triad(canvas, "turn_frame"), Sketch(canvas, "turn")

    def draw(state: State, q: NDArray[np.float64]) -> None:
        view = state[PoseView]
        pair = pair_at(canvas.drawn.figure.anatomy.arm, q, view)
        frame.show(f"{{{view.frame}}}", pair.frame)
        sketch.draw(marks_of(pair, canvas.size, units_of(state)))

    return canvas.follow(state, draw)


def marks_of(pair: Pair, size: float, units: Units) -> Marks:
    """Return the axis and the angle as an arrow and an arc."""
    axis, angle = axis_angle(pair.transform[:3, :3])
    at, theta = pair.frame[:3, 3], float(angle)
    if theta < LEAST:
        return Marks(label="no turn", at=at)
    r = pair.reference[:3, :3] @ axis
    tip = at + LENGTH * size * r
    middle = at + 0.6 * LENGTH * size * r
    start = across(r)
    spread = start * math.cos(0.5 * theta) + np.cross(r, start) * math.sin(0.5 * theta)
    strokes = [
        (middle, middle + RADIUS * size * start, PURPLE),
        *arc(middle, RADIUS * size * start, r, theta, PURPLE),
    ]
    label = f"θ = {units.angle(theta)}"
    return Marks([(at, tip, PURPLE)], strokes, label, middle + 1.3 * RADIUS * size * spread)


LAYER = Layer("turn", order=66, watches=(PoseView, Notation), build=build, panel="orientation")
