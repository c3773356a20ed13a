"""The absolute encoder in the scene, in the place of the arm."""

from __future__ import annotations

from functools import partial

from armlab.benches.sensor.absolute.state import Absolute
from armlab.benches.sensor.absolute.ui.heads import Encoder, Head
from armlab.benches.sensor.absolute.ui.wheel import absolute_glb, radii
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import OF_THE_ARM, Layer, Show

HIDES = (*OF_THE_ARM, "gizmo", "gap")
"""Layers in whose place the encoder is drawn."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the disk, its sensors and the word."""
    encoder = Encoder(canvas, "absolute", state)

    def show(state: State) -> None:
        part = state[Absolute]
        of = (part.code, part.tracks)
        encoder.show(of, partial(absolute_glb, *of), part.angle, heads(part), label(part))

    return show


def heads(part: Absolute) -> list[Head]:
    """Return the sensors of the tracks, and which of them are lit."""
    disk, word = part.disk, int(part.disk.word(part.angle))
    return [
        Head(
            0.5 * (low + high),
            high - low,
            disk.offset if track == disk.track else 0.0,
            bool(word >> (disk.tracks - track) & 1),
        )
        for track, (low, high) in enumerate(radii(disk.tracks).tolist(), 1)
    ]


def label(part: Absolute) -> str:
    """Return the word that is seen, and the sector that it stands for."""
    word, read = int(part.disk.word(part.angle)), int(part.disk.read(part.angle))
    return f"{word:0{part.tracks}b} = sector {read}"


LAYER = Layer("absolute_encoder", order=80, watches=(Absolute, RobotPart), build=build, panel="absolute_encoder")
