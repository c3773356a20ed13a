"""The assignment trainer in the scene: joint axes, the frames a person places, and the arm of the table over it."""

from __future__ import annotations

from armlab.session.parts.display import Display
from armlab.session.parts.trainer import Trainer
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.layers._trainer_frames import PlacedFrames
from armlab.ui.layers._trainer_ghost import Ghost
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw axes and frames on the bodies, and the arm of the table beside them."""
    frames: PlacedFrames | None = None
    ghost = Ghost(canvas)

    def show(state: State) -> None:
        nonlocal frames
        trainer = state[Trainer]
        if frames is None and trainer.started:
            frames = PlacedFrames(canvas, trainer.exercise)
        if frames is not None:
            frames.show(trainer, DARK.on(state))
        ghost.show(trainer)

    return show


LAYER = Layer("trainer", order=82, watches=(Trainer, Display), build=build, panel="trainer")
