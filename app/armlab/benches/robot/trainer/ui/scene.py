"""The assignment trainer in the scene: joint axes, the frames of the student, and the arm of the student's table."""

from __future__ import annotations

import numpy as np

from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.frames import PlacedFrames
from armlab.benches.robot.trainer.ui.ghost import Ghost
from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import frame_glb
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK

WORLD, BESIDE = 0.14, 0.13
"""Length of the world's axes and their distance from the foot, in sizes of the arm."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw axes and frames on the bodies, and the arm of the table beside them."""
    frames: PlacedFrames | None = None
    ghost = Ghost(canvas)
    _add_world(canvas)

    def show(state: State) -> None:
        nonlocal frames
        trainer = state[Trainer]
        if frames is None and trainer.started:
            frames = PlacedFrames(canvas, trainer.exercise)
        if frames is not None:
            frames.show(trainer, DARK.on(state))
        ghost.show(trainer)

    return show


def _add_world(canvas: LayerCanvas) -> None:
    """Draw the axes of the world, from which directions are chosen, beside the foot of the arm."""
    root, length = canvas.drawn.figure.anatomy.root, WORLD * canvas.size
    at = root[:3, 3] + np.array([-BESIDE * canvas.size, -BESIDE * canvas.size, 0.0])
    canvas.scene.add_glb(
        canvas.path("trainer/world"),
        frame_glb(),
        scale=length,
        position=at,
        cast_shadow=False,
        receive_shadow=False,
    )
    for axis, direction in zip("xyz", np.eye(3), strict=True):
        canvas.scene.add_label(
            canvas.path(f"trainer/world_{axis}"),
            f"+{axis}",
            position=at + 1.15 * length * direction,
            font_screen_scale=0.85,
        )


LAYER = Layer("trainer", order=82, watches=(Trainer, Display), build=build, panel="trainer")
