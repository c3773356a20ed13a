"""A disk in the scene with its lamps and sensors: beams pass where it lets light through."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.absolute.ui.wheel import BACK, FRONT, LIT, frame_glb, sensor_glb
from armlab.benches.sensor.stage import stage_of, turned
from armlab.session.state import State
from armlab.ui.colours import GREY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._marks import Marks, Segment, Sketch
from armlab.ui.scene._nodes import move, put, seen, write

Floats = NDArray[np.float64]

SIZE = 0.07
"""Largest edge of a sensor, in radii of the disk."""

ROOM = 0.8
"""Part of the width of its track that a sensor takes."""

ABOVE = 1.38
"""Height of the label over the middle of the disk, in radii."""


@dataclass(frozen=True)
class Head:
    """A lamp and a sensor over a track.

    Attributes
    ----------
    radius, width : float
        Middle and width of the track, in radii of the disk.
    ahead : float
        How far the sensor is ahead of the line of sensors, radians.
    lit : bool
    """

    radius: float
    width: float
    ahead: float
    lit: bool


class Encoder:
    """A disk that is turned in its bracket.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
        Of its nodes.
    state : State
    """

    def __init__(self, canvas: LayerCanvas, name: str, state: State) -> None:
        self._canvas, self._name = canvas, canvas.path(name)
        self._pose, self._radius = stage_of(state)
        looks: dict[str, Any] = {"scale": self._radius, "cast_shadow": True, "receive_shadow": False}
        frame = canvas.scene.add_glb(f"{self._name}/frame", frame_glb(), **looks)
        put(frame, self._pose)
        self._disk: Any = None
        self._of: object = None
        self._sensors: list[tuple[Any, Any]] = []
        self._sizes: tuple[float, ...] = ()
        self._beams = Sketch(canvas, f"{name}/beams", 0.5)
        self._label = canvas.scene.add_label(
            f"{self._name}/label",
            "",
            font_screen_scale=1.0,
            anchor="bottom-center",
            position=self._pose[:3, 3] + ABOVE * self._radius * self._pose[:3, 1],
        )

    def show(self, of: object, make: Callable[[], bytes], angle: float, heads: Sequence[Head], label: str) -> None:
        """Show a disk at an angle in radians with its sensors, and a text above them.

        Parameters
        ----------
        of : object
            Key of the disk: another one is made with ``make``.
        make : callable
        angle : float
        heads : sequence of Head
        label : str
        """
        if of != self._of:
            self._of = of
            if self._disk is not None:
                self._disk.remove()
            self._disk = self._canvas.scene.add_glb(
                f"{self._name}/disk", make(), scale=self._radius, cast_shadow=True, receive_shadow=False
            )
        put(self._disk, turned(self._pose, angle))
        self._show_sensors(heads)
        self._beams.draw(Marks(strokes=[self._beam(head) for head in heads]))
        write(self._label, label)

    def _show_sensors(self, heads: Sequence[Head]) -> None:
        sizes = tuple(min(SIZE, ROOM * head.width) for head in heads)
        if sizes != self._sizes:
            self._sizes = sizes
            for node in (node for pair in self._sensors for node in pair):
                node.remove()
            self._sensors = [
                (self._sensor(k, False, size), self._sensor(k, True, size)) for k, size in enumerate(sizes)
            ]
        for (dark, lit), head in zip(self._sensors, heads, strict=True):
            pose = turned(self._pose, -head.ahead)
            at = pose[:3, 3] + self._radius * (head.radius * pose[:3, 1] + FRONT * pose[:3, 2])
            for node, on in ((dark, not head.lit), (lit, head.lit)):
                seen(node, on)
                put(node, pose)
                move(node, at)

    def _sensor(self, k: int, lit: bool, size: float) -> Any:
        path = f"{self._name}/sensor{k}/{'lit' if lit else 'dark'}"
        scale = size * self._radius
        return self._canvas.scene.add_glb(path, sensor_glb(lit), scale=scale, cast_shadow=False, receive_shadow=False)

    def _beam(self, head: Head) -> Segment:
        """Return the light of a lamp: to its sensor, or to the back of the disk."""
        pose = turned(self._pose, -head.ahead)
        foot = pose[:3, 3] + self._radius * head.radius * pose[:3, 1]
        ends = [foot + self._radius * z * pose[:3, 2] for z in (BACK, FRONT if head.lit else 0.0)]
        return ends[0], ends[1], LIT if head.lit else GREY
