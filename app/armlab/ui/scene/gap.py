"""A dashed line from the tool to a target that it does not reach, in the colour of the verdict."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target, target_pose, verdict
from armlab.session.state import State
from armlab.ui.colours import VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.verdicts import verdict_kind

DASH, SPACE, THICKNESS = 0.018, 0.012, 0.003
"""Lengths of dashes and gaps, and thickness, in sizes of the arm."""

MOST_DASHES = 200
VISIBLE = 1e-3
"""Shortest gap that is drawn, in sizes of the arm."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the gap when there is one."""
    line: viser.LineSegmentsHandle | None = None

    def show(state: State) -> None:
        nonlocal line
        gap = np.zeros(3)
        if state[Target].pose is not None:
            gap = target_pose(state)[:3, 3] - state[Joints].tool_pose[:3, 3]
        if np.linalg.norm(gap) < VISIBLE * canvas.size:
            if line is not None:
                line.remove()
                line = None
            return
        points = _dashes(state[Joints].tool_pose[:3, 3], gap, canvas.size)
        colour = VERDICT[verdict_kind(state.derived(verdict))]
        if line is None:
            line = canvas.scene.add_line_segments(canvas.path("gap"), points, colour, thickness=THICKNESS * canvas.size)
        else:
            line.points = points
            line.colors = np.array(colour, dtype=np.uint8)

    return show


def _dashes(start: NDArray[np.floating], gap: NDArray[np.floating], size: float) -> NDArray[np.float32]:
    """Return the ends of the dashes, (k, 2, 3)."""
    length = float(np.linalg.norm(gap))
    period = max((DASH + SPACE) * size, length / MOST_DASHES)
    begins = np.arange(0.0, length, period)
    ends = np.minimum(begins + period * DASH / (DASH + SPACE), length)
    marks = np.stack([begins, ends], axis=1)[:, :, None] / length
    return np.asarray(start + marks * gap, dtype=np.float32)


LAYER = Layer("gap", order=60, watches=(Joints, Target), build=build)
