"""The path of the tool point as it was shown."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.session.state import State
from armlab.ui.colours import BLUE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import Switch

STEP = 0.004
"""Distance between the points that are kept, in sizes of the arm."""

CHUNK = 64
CHUNKS = 40
"""Number of segments in a node of the scene, and of nodes that are kept: only the newest is sent again."""


class Trace:
    """The shown tool points, drawn in chunks."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._points: list[NDArray[np.float64]] = []
        self._chunks: list[viser.LineSegmentsHandle] = []
        self._made = 0

    def add(self, q: NDArray[np.float64]) -> None:
        """Add a shown configuration."""
        point = self._canvas.drawn.figure.anatomy.arm.position(q)
        if self._points and np.linalg.norm(point - self._points[-1]) < STEP * self._canvas.size:
            return
        self._points.append(np.array(point))
        if len(self._points) > 1:
            self._draw()

    def _draw(self) -> None:
        points = np.array(self._points, dtype=np.float32)
        segments = np.stack([points[:-1], points[1:]], axis=1)
        name = self._canvas.path(f"trace/{self._made}")
        handle = self._canvas.scene.add_line_segments(name, segments, BLUE, thickness=0.0035 * self._canvas.size)
        self._chunks[-1:] = [handle] if self._chunks and self._chunks[-1].name == name else [*self._chunks[-1:], handle]
        if len(segments) >= CHUNK:
            self._points = self._points[-1:]
            self._made += 1
        while len(self._chunks) > CHUNKS:
            self._chunks.pop(0).remove()

    def lift(self) -> None:
        """Begin another stroke: while nobody looks the tool may go elsewhere."""
        self._points.clear()
        self._made += 1

    def clear(self) -> None:
        """Forget the path."""
        for chunk in self._chunks:
            chunk.remove()
        self._chunks.clear()
        self.lift()


def build(canvas: LayerCanvas, state: State) -> Show:
    """Follow the tool while the switch is on; switching off clears the path."""
    trace = Trace(canvas)
    canvas.on_pose(trace.add)
    canvas.on_hide(trace.lift)
    canvas.on_off(trace.clear)
    # A stroke begins where the tool stands when the trace comes or comes back, not where its next move has taken it.
    return lambda state: trace.add(canvas.shown_pose)


SWITCH = Switch("trace", "Trace", "The path of the tool point. Switch off to clear it.", "T")
LAYER = Layer("trace", order=70, watches=(), build=build, switch=SWITCH, silent=True)
