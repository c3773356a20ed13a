"""The incremental encoder in the scene, in the place of the arm."""

from __future__ import annotations

from functools import partial

from armlab.benches.sensor.absolute.ui.heads import Encoder, Head
from armlab.benches.sensor.absolute.ui.wheel import radii
from armlab.benches.sensor.incremental.counting import now
from armlab.benches.sensor.incremental.state import Incremental
from armlab.benches.sensor.incremental.ui.disk import FINEST, NAMES, incremental_glb, seen
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the disk, its sensors and the count."""
    encoder = Encoder(canvas, "incremental", state)

    def show(state: State) -> None:
        part, found = state[Incremental], state.derived(now)
        encoder.show(
            min(part.pulses, FINEST + 1),
            partial(incremental_glb, part.pulses),
            found.angle,
            heads(part, found.angle),
            f"{levels(part, found.angle)}: count {found.counted[part.decoder].count}".replace("-", "−"),
        )

    return show


def heads(part: Incremental, angle: float) -> list[Head]:
    """Return the sensors of Z, B and A, from the innermost, and which of them are lit."""
    lit = reversed(seen(part, angle))
    return [
        Head(0.5 * (low + high), high - low, 0.0, on)
        for (low, high), on in zip(radii(len(NAMES)).tolist(), lit, strict=True)
    ]


def levels(part: Incremental, angle: float) -> str:
    """Return what the sensors see, in a few words."""
    return ", ".join(f"{name} {int(on)}" for name, on in zip(NAMES, seen(part, angle), strict=True))


LAYER = Layer(
    "incremental_encoder",
    order=81,
    watches=(Incremental, Timeline, RobotPart),
    build=build,
    panel="incremental_encoder",
)
