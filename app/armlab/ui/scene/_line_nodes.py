"""Nodes of the planning steps for any number of points; each is made when it first has something to show."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._nodes import add_triad, move, put, seen, write
from armlab.ui.scene._strokes import Segments, add_line, add_name

Floats = NDArray[np.float64]

MOST_FRAMES = 12
"""Largest number of knots that are drawn with a frame; further ones are points only."""

FRAME = 0.5
"""Size of the frame of a knot, relative to other frames."""


class Lines:
    """Lines of one colour."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb, thickness: float) -> None:
        self._canvas, self._path, self._colour, self._thickness = canvas, canvas.path(name), colour, thickness
        self._node: viser.LineSegmentsHandle | None = None
        self._shown: Segments | None = None

    def show(self, segments: Segments | None) -> None:
        """Show segments, (k, 2, 3); None, or an empty array, hides the node."""
        if segments is None or not len(segments):
            if self._node is not None:
                seen(self._node, False)
            return
        if self._node is None:
            size = self._canvas.size
            self._node = add_line(self._canvas.scene, self._path, segments, self._colour, size, self._thickness)
        elif self._shown is None or not np.array_equal(segments, self._shown):
            self._node.points = segments
        self._shown = segments
        seen(self._node, True)


class Dots:
    """Points of one colour."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb) -> None:
        self._canvas, self._path, self._colour = canvas, canvas.path(name), colour
        self._node: viser.PointCloudHandle | None = None

    def show(self, points: Floats | None, diameter: float = 0.01) -> None:
        """Show points, (k, 3), with a diameter in sizes of the arm; None, or an empty array, hides the node."""
        if points is None or not len(points):
            if self._node is not None:
                seen(self._node, False)
            return
        place, width = points.astype(np.float32), diameter * self._canvas.size
        if self._node is None:
            self._node = self._canvas.scene.add_point_cloud(
                self._path,
                place,
                self._colour,
                point_size=width,
                point_shape="circle",
                point_shading="flat",
                precision="float32",
            )
        elif not np.array_equal(self._node.points, place):
            self._node.points = place
        if self._node.point_size != width:
            self._node.point_size = width
        seen(self._node, True)


class Frames:
    """Any number of frames with names."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas, self._path = canvas, canvas.path(name)
        self._made: list[tuple[viser.GlbHandle, viser.LabelHandle]] = []

    def show(self, poses: Floats, names: list[str]) -> None:
        """Show frames at poses, (k, 4, 4); only the first few are drawn."""
        drawn = poses[:MOST_FRAMES]
        while len(self._made) < len(drawn):
            path = f"{self._path}{len(self._made)}"
            frame = add_triad(self._canvas.scene, path, FRAME * self._canvas.size)
            self._made.append((frame, add_name(self._canvas.scene, f"{path}/name", "", np.zeros(3), "bottom-left")))
        for k, (frame, label) in enumerate(self._made):
            there = k < len(drawn)
            seen(frame, there)
            seen(label, there and bool(names[k]))
            if there:
                put(frame, drawn[k])
                write(label, names[k])


class Mark:
    """A point with a name."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb, diameter: float, anchor: str) -> None:
        self._dot, self._diameter = Dots(canvas, name, colour), diameter
        self._label = add_name(canvas.scene, canvas.path(f"{name}/name"), "", np.zeros(3), anchor)

    def show(self, point: Floats | None, text: str = "") -> None:
        """Show the point; None hides it."""
        self._dot.show(None if point is None else point[None], self._diameter)
        seen(self._label, point is not None)
        if point is not None:
            move(self._label, point)
            write(self._label, text)
