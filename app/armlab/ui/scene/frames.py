"""All Denavit-Hartenberg frames and the frame of the tool; frames in one place are nested and share a label."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH, frame_glb
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import Switch

SHRINK = 0.72
"""Size of each further frame in the same place, relative to the one before."""

OF_TOOL = 0.6
"""Size of the frame of the tool, relative to the others: the handle of the target mostly stands in the same place."""

TOOL = "E"
"""Name of the tool's frame."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach a frame with its label to each body, with which it moves."""
    for group in _groups(canvas):
        for rank, mark in enumerate(group):
            canvas.scene.add_glb(
                f"{canvas.node(mark.body)}/frame{mark.name}",
                frame_glb(),
                scale=FRAME_LENGTH * canvas.size * SHRINK**rank * (OF_TOOL if mark.name == TOOL else 1.0),
                wxyz=quaternion_from_rotation(mark.pose[:3, :3]),
                position=mark.pose[:3, 3],
                cast_shadow=False,
                receive_shadow=False,
            )
        first = group[0]
        corner = 0.35 * FRAME_LENGTH * canvas.size * (first.pose[:3, 0] + first.pose[:3, 1])
        canvas.scene.add_label(
            f"{canvas.node(first.body)}/label{first.name}",
            "{" + ", ".join(mark.name for mark in group) + "}",
            position=first.pose[:3, 3] + corner,
            font_screen_scale=0.85,
        )
    return lambda state: None


@dataclass(frozen=True, eq=False)
class _Mark:
    """A frame: its name, its body, and its pose on that."""

    name: str
    body: int
    pose: NDArray[np.float64]


def _groups(canvas: LayerCanvas) -> list[list[_Mark]]:
    """Return the frames, grouped by a common origin in every configuration."""
    anatomy = canvas.drawn.figure.anatomy
    arm, n = anatomy.arm, len(anatomy.bodies)
    marks = [_Mark(str(i), *anatomy.frame_on_body(i)) for i in range(n + 1)]
    marks.append(_Mark(TOOL, n, anatomy.tool_on_last()))
    # Two configurations without symmetry: origins that coincide in both always do.
    configurations = [arm.limits[:, 0] + part * (arm.limits[:, 1] - arm.limits[:, 0]) for part in (0.31, 0.73)]
    origins = [[*(T[:3, 3] for T in arm.frames(q)), arm.fk(q)[:3, 3]] for q in configurations]
    groups: list[list[int]] = []
    for k in range(len(marks)):
        for group in groups:
            if all(np.linalg.norm(at[k] - at[group[0]]) < 1e-6 * canvas.size for at in origins):
                group.append(k)
                break
        else:
            groups.append([k])
    return [[marks[k] for k in group] for group in groups]


SWITCH = Switch("frames", "Frames", "All Denavit–Hartenberg frames {0} to {n} and the tool's frame {E}.", "F")
LAYER = Layer("frames", order=20, watches=(), build=build, switch=SWITCH, silent=True)
