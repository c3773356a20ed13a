"""Velocities in the scene: the parts of the joints tip to tail, their sum, two points of a link, and the selection."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.speeds.motion import moving_at, speeds_of, two_points_at
from armlab.benches.velocity.speeds.state import MATRIX, Velocity, drawn_scales
from armlab.benches.velocity.speeds.ui.marks import Look, parts_marks, point_marks, selected_marks, sum_marks
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Selection
from armlab.session.state import State
from armlab.ui.colours import INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Sketch
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

LINEAR, ANGULAR = slice(0, 3), slice(3, 6)

SKETCHES = {"parts": 0.7, "turns": 0.7, "v": 0.8, "omega": 0.6, "first": 0.65, "second": 0.65, "lit": 0.75}
"""Sketches of the scene by key, with their thickness."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the arrows of the chosen speeds, or of the selection, and follow the arm."""
    sketches = {key: Sketch(canvas, f"velocity/{key}", weight) for key, weight in SKETCHES.items()}

    def draw(state: State, q: NDArray[np.float64]) -> None:
        found = marks_of(state, q, canvas.size)
        for key, sketch in sketches.items():
            sketch.draw(found.get(key, NOTHING))

    return canvas.follow(state, draw)


NOTHING = Marks()


def marks_of(state: State, q: NDArray[np.float64], size: float) -> dict[str, Marks]:
    """Return the marks at a shown configuration, by the keys of `SKETCHES`."""
    part, arm = state[Velocity], state[Joints].arm
    speeds = state.derived(speeds_of)
    look = Look(size, drawn_scales(arm, part.qdot), units_of(state), INK[DARK.on(state)])
    moving = moving_at(arm, q, speeds, part.axes)
    selected = state[Selection].of(MATRIX, columns=arm.n)
    if selected.matrix:
        return {"lit": selected_marks(arm, moving, selected, look)}
    found: dict[str, Marks] = {}
    if "v" in part.marks:
        found["parts"] = parts_marks(moving, look, LINEAR)
        found["v"] = sum_marks(moving, look, LINEAR)
    if "omega" in part.marks:
        found["turns"] = parts_marks(moving, look, ANGULAR)
    if part.marks & {"v", "omega"}:
        found["omega"] = sum_marks(moving, look, ANGULAR)
    if "points" in part.marks:
        found["first"], found["second"] = point_marks(two_points_at(arm, q, speeds, part), look)
    return found


LAYER = Layer(
    "velocity",
    order=66,
    watches=(Velocity, Selection, Notation, Display, Joints),
    build=build,
    panel="velocity",
)
