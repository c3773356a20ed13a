"""Drawings of one run: the path of its tool with a point at each iterate, and its arm as a thin line."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.iterate.runs.films import Film
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import along
from armlab.ui.scene._nodes import put, seen
from armlab.ui.scene._strokes import add_head, add_line, polyline

WAY, SHAFT = 0.0035, 0.005
"""Thickness of the path, and of the arrow of the error, in sizes of the arm."""

POINT, HEAD = 0.008, 0.03
"""Diameter of a point and length of an arrow's head, in sizes of the arm."""

LEAST = 0.02
"""Shortest error drawn as an arrow, in sizes of the arm."""

Floats = NDArray[np.float64]


class Way:
    """The path of the tool in a run."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb) -> None:
        self._canvas, self._path, self._colour = canvas, canvas.path(name), colour
        self._line: viser.LineSegmentsHandle | None = None
        self._points: viser.PointCloudHandle | None = None
        self._film: Film | None = None

    def show(self, film: Film | None) -> None:
        """Show the path of a film; None hides it."""
        if film is not None and film is not self._film:
            self._film = film
            self._draw(film.way)
        for node in (self._line, self._points):
            if node is not None:
                seen(node, film is not None)

    def _draw(self, way: Floats) -> None:
        scene, size = self._canvas.scene, self._canvas.size
        lines = polyline(way if len(way) > 1 else np.repeat(way, 2, axis=0))
        points = way.astype(np.float32)
        if self._line is None or self._points is None:
            self._line = add_line(scene, f"{self._path}/line", lines, self._colour, size, WAY)
            self._points = scene.add_point_cloud(
                f"{self._path}/points",
                points,
                self._colour,
                point_size=POINT * size,
                point_shape="circle",
                point_shading="flat",
                precision="float32",
            )
            return
        self._line.points = lines
        self._points.points = points


class ErrorArrow:
    """The error of the position as an arrow from the tool to the target."""

    def __init__(self, canvas: LayerCanvas, colour: Rgb) -> None:
        scene, size, path = canvas.scene, canvas.size, canvas.path("iterations/error")
        self._size = size
        self._line = add_line(scene, f"{path}/line", np.zeros((1, 2, 3), dtype=np.float32), colour, size, SHAFT)
        self._head = add_head(scene, f"{path}/head", np.zeros(3), (0.0, 0.0, 1.0), colour, HEAD * size)

    def show(self, tool: Floats | None, target: Floats) -> None:
        """Show the arrow; None instead of a tool point hides it."""
        way = np.zeros(3) if tool is None else target - tool
        length = float(np.linalg.norm(way))
        drawn = tool is not None and length > LEAST * self._size
        for node in (self._line, self._head):
            seen(node, drawn)
        if tool is None or not drawn:
            return
        back = min(HEAD * self._size, 0.5 * length) * way / length
        self._line.points = np.array([[tool, target - back]], dtype=np.float32)
        put(self._head, along(way / length, target - back))
        self._head.scale = float(np.linalg.norm(back))
