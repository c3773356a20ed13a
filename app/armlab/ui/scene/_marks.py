"""Arrows, strokes and one label that are drawn again as the arm moves, and frames that are moved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.colours import Rgb, line_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.scene._nodes import add_triad, move, put, seen, write

Vector = NDArray[np.floating]
Segment = tuple[Vector, Vector, Rgb]
Make = Callable[[str, NDArray[np.float32], NDArray[np.uint8]], Any]

SHAFT, HEAD_WIDTH, HEAD = 0.0075, 0.019, 0.05
STROKE = 0.005
"""Thickness of arrows and strokes, in sizes of the arm."""

ARC_PARTS = 36
"""Number of strokes of an arc, always the same, so that only their ends are sent while the arm moves."""


@dataclass(frozen=True)
class Marks:
    """Marks to be drawn, in the world.

    Attributes
    ----------
    arrows, strokes : list of (start, end, colour)
    label : str
        Empty for none.
    at : ndarray, shape (3,)
        Where the label is.
    """

    arrows: list[Segment] = field(default_factory=list)
    strokes: list[Segment] = field(default_factory=list)
    label: str = ""
    at: Vector = field(default_factory=lambda: np.zeros(3))


def arc(middle: Vector, start: Vector, axis: Vector, angle: float, colour: Rgb) -> list[Segment]:
    """Return the strokes of the path of ``middle + start`` turned about a unit axis through ``middle``."""
    angles = np.linspace(0.0, angle, ARC_PARTS + 1)[:, None]
    along = (axis @ start) * axis
    points = middle + along + np.cos(angles) * (start - along) + np.sin(angles) * np.cross(axis, start)
    return [(a, b, colour) for a, b in pairwise(points)]


def across(axis: Vector) -> Vector:
    """Return a unit vector perpendicular to an axis."""
    least = np.eye(3)[int(np.argmin(np.abs(axis)))]
    normal = np.cross(axis, least)
    return np.asarray(normal / np.linalg.norm(normal))


class _Segments:
    """One node with many segments, which is made again only when their colours or their number change."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._handle: Any = None
        self._points, self._colours = _arrays([])

    def draw(self, segments: list[Segment], make: Make) -> None:
        """Draw these segments in place of the present ones."""
        points, colours = _arrays(segments)
        if np.array_equal(colours, self._colours):
            if not np.array_equal(points, self._points):
                self._handle.points = self._points = points
            return
        self.forget()
        self._points, self._colours = points, colours
        self._handle = make(self._path, points, colours) if segments else None

    def forget(self) -> None:
        """Remove the node; the next drawing makes another."""
        self._points, self._colours = _arrays([])
        if self._handle is not None:
            self._handle.remove()
        self._handle = None


class Sketch:
    """Draws marks; nodes are made when they are first needed and only written when something has changed.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
    weight : float
        How thick, in usual thicknesses.
    """

    def __init__(self, canvas: LayerCanvas, name: str, weight: float = 1.0) -> None:
        self._canvas, self._name, self._weight = canvas, name, weight
        self._arrows, self._strokes = (_Segments(canvas.path(f"{name}/{kind}")) for kind in ("arrows", "strokes"))
        self._label: viser.LabelHandle | None = None

    def weigh(self, weight: float) -> None:
        """Draw in another thickness from now on."""
        if weight != self._weight:
            self._weight = weight
            self._arrows.forget()
            self._strokes.forget()

    def draw(self, marks: Marks) -> None:
        """Draw these marks in place of the present ones."""
        size = self._weight * self._canvas.size
        self._arrows.draw(
            marks.arrows,
            lambda name, points, colours: self._canvas.scene.add_arrows(
                name,
                points,
                colours,
                shaft_radius=SHAFT * size,
                head_radius=HEAD_WIDTH * size,
                head_length=HEAD * size,
            ),
        )
        self._strokes.draw(
            marks.strokes,
            lambda name, points, colours: self._canvas.scene.add_line_segments(
                name, points, np.repeat(colours[:, None, :], 2, axis=1), thickness=STROKE * size
            ),
        )
        self._draw_label(marks.label, marks.at)

    def _draw_label(self, text: str, at: Vector) -> None:
        if self._label is None:
            if not text:
                return
            self._label = self._canvas.scene.add_label(
                self._canvas.path(f"{self._name}/label"),
                text,
                font_screen_scale=0.9,
                anchor="bottom-left",
                position=np.asarray(at, dtype=float),
            )
        seen(self._label, bool(text))
        if text:
            write(self._label, text)
            move(self._label, at)


class Named:
    """A label at a point of the scene."""

    def __init__(self, canvas: LayerCanvas, name: str, text: str = "") -> None:
        self._label: viser.LabelHandle = canvas.scene.add_label(
            canvas.path(name), text, font_screen_scale=0.9, anchor="center-center"
        )

    def show(self, text: str, at: Vector) -> None:
        """Show a text at a point (3,); an empty one hides it."""
        seen(self._label, bool(text))
        if text:
            write(self._label, text)
            move(self._label, at)


class Triad:
    """A frame with its name, moved to a pose."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._node = add_triad(canvas.scene, canvas.path(name), canvas.size)
        self._label = canvas.scene.add_label(
            canvas.path(f"{name}_label"), "", font_screen_scale=0.85, anchor="top-right"
        )
        self._corner = -0.25 * FRAME_LENGTH * canvas.size
        self._pose: NDArray[np.floating] | None = None

    def visible(self, on: bool) -> None:
        """Show or hide the frame."""
        seen(self._node, on)
        seen(self._label, on)

    def show(self, name: str, pose: NDArray[np.floating]) -> None:
        """Show the frame at a pose, with this name."""
        write(self._label, name)
        if self._pose is not None and np.array_equal(pose, self._pose):
            return
        self._pose = pose
        put(self._node, pose)
        move(self._label, pose[:3, 3] + self._corner * pose[:3, :3].sum(axis=1))


def _arrays(segments: list[Segment]) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Return ends (k, 2, 3) and colours (k, 3), as linear light, which viser expects for arrows and lines."""
    points = np.array([[start, end] for start, end, _ in segments], dtype=np.float32).reshape(-1, 2, 3)
    colours = np.array([_linear(colour) for _, _, colour in segments], dtype=np.uint8).reshape(-1, 3)
    return points, colours


@cache
def _linear(colour: Rgb) -> Rgb:
    return line_colour(colour)
