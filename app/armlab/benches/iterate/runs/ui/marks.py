"""What is drawn of one run: the way of its tool with a point at each iterate, and its arm as a thin line."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from armlab.benches.iterate.runs.films import Film
from armlab.kin.arm import Arm
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import along
from armlab.ui.scene._nodes import put, seen
from armlab.ui.scene._sticks import corners_of
from armlab.ui.scene._strokes import Segments, add_head, add_line, polyline

WAY, STICK, SHAFT = 0.0035, 0.007, 0.005
"""Thickness of the way, of an arm, and of the arrow of the error, in sizes of the arm."""

POINT, HEAD = 0.008, 0.03
"""Size of a point and of a head, in sizes of the arm."""

LEAST = 0.02
"""Shortest error drawn as an arrow, in sizes of the arm."""

Floats = NDArray[np.float64]


def stick_lines(arm: Arm, q: ArrayLike) -> Segments:
    """Return an arm along the lengths of its table, (k, 2, 3)."""
    return polyline(corners_of(arm, np.asarray(q, dtype=float)[None])[0])


class Stick:
    """An arm as a thin line; made when it is first to be seen."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb, thickness: float = STICK) -> None:
        self._canvas, self._path, self._colour, self._thickness = canvas, canvas.path(name), colour, thickness
        self._arm = canvas.drawn.figure.anatomy.arm
        self._line: viser.LineSegmentsHandle | None = None
        self._q: bytes = b""

    def show(self, q: Floats | None) -> None:
        """Show it in a configuration; None hides it."""
        if q is None:
            if self._line is not None:
                seen(self._line, False)
            return
        if self._line is None:
            lines = stick_lines(self._arm, q)
            self._line = add_line(
                self._canvas.scene, self._path, lines, self._colour, self._canvas.size, self._thickness
            )
        elif q.tobytes() != self._q:
            self._line.points = stick_lines(self._arm, q)
        self._q = q.tobytes()
        seen(self._line, True)


class Way:
    """Where the tool of a run has been."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb) -> None:
        self._canvas, self._path, self._colour = canvas, canvas.path(name), colour
        self._line: viser.LineSegmentsHandle | None = None
        self._points: viser.PointCloudHandle | None = None
        self._film: Film | None = None

    def show(self, film: Film | None) -> None:
        """Show the way of a film; None hides it."""
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
        """Show it; no tool hides it."""
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
