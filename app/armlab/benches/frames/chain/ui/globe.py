"""A translucent globe about a frame, with meridians and circles of latitude that turn with it."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.colours import GREY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._nodes import put, seen
from armlab.ui.scene._strokes import Segments, polyline

Floats = NDArray[np.float64]

PARTS = 48
"""Number of strokes of a circle."""

MERIDIANS, PARALLELS = 6, 5

OPACITY, LINE = 0.16, 0.008
"""Opacity of the globe, and thickness of its lines, in radii."""

LEAST = 1e-9
"""Least radius that is drawn, metres."""


class Globe:
    """The globe, which is made when it is first wanted."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas, self._name = canvas, name
        self._node: viser.FrameHandle | None = None
        self._scaled: list[viser.IcosphereHandle | viser.LineSegmentsHandle] = []

    def show(self, frame: Floats, p: Floats, on: bool) -> None:
        """Show the globe about a frame (4, 4) with a point (3,) on its surface, both in the world, or hide it."""
        radius = float(np.linalg.norm(p - frame[:3, 3]))
        on = on and radius > LEAST
        if self._node is None and on:
            self._node = self._made()
        if self._node is None:
            return
        seen(self._node, on)
        if not on:
            return
        put(self._node, frame)
        for node in self._scaled:
            if node.scale != radius:
                node.scale = radius

    def _made(self) -> viser.FrameHandle:
        scene, path = self._canvas.scene, self._canvas.path(self._name)
        node = scene.add_frame(path, show_axes=False)
        ball = scene.add_icosphere(
            f"{path}/ball", 1.0, color=GREY, subdivisions=4, opacity=OPACITY, cast_shadow=False, receive_shadow=False
        )
        self._scaled = [ball, scene.add_line_segments(f"{path}/lines", circles(), GREY, thickness=LINE)]
        return node


def circles() -> Segments:
    """Return meridians and circles of latitude of a globe of radius 1 whose poles are on the y axis, (k, 2, 3)."""
    turned = np.linspace(0.0, 2.0 * np.pi, PARTS + 1)
    found = []
    for angle in np.arange(MERIDIANS) * np.pi / MERIDIANS:
        across = np.array([np.cos(angle), 0.0, np.sin(angle)])
        found.append(np.outer(np.cos(turned), [0.0, 1.0, 0.0]) + np.outer(np.sin(turned), across))
    for k in range(1, PARALLELS + 1):
        height = np.pi * k / (PARALLELS + 1)
        ring = np.stack([np.cos(turned), np.zeros_like(turned), np.sin(turned)], axis=1)
        found.append(np.sin(height) * ring + np.array([0.0, np.cos(height), 0.0]))
    return np.concatenate([polyline(points) for points in found]).astype(np.float32)
