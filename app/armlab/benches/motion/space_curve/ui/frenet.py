"""The moving Frenet frame t, n, b of a curve in space, with its circle of curvature."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import BLUE, ORANGE, PURPLE, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import add_solid, move, seen, turn
from armlab.ui.scene._strokes import NAME_SCALE, Segments, polyline

Floats = NDArray[np.float64]

COLOURS: dict[str, Rgb] = {"t": ORANGE, "n": PURPLE, "b": BLUE}

WIDTH = 0.032
"""Half thickness of an arrow, in its length."""

CIRCLE = 0.0024
"""Thickness of the circle, in sizes of the arm."""

SIDES = 72
LARGEST, LEAST = 60.0, 0.02
"""Largest and least radius of a circle that is drawn, in lengths of the arrows: others would look like a line, or a
point."""

ARC = 4.0
"""Length of the arc of a large circle to either side, in lengths of the arrows: all of it would fill the scene."""

NAME_AT = 1.16
"""Distance of the name of an arrow, in its length."""


class FrenetFrame:
    """Three arrows and a circle, which a picture moves without rebuilding them.

    Parameters
    ----------
    canvas : LayerCanvas
    path : str
        Name of its node, such as ``"space_curve/frenet"``.
    length : float
        Of the arrows, metres; see `resize`.
    """

    def __init__(self, canvas: LayerCanvas, path: str, length: float) -> None:
        scene, name = canvas.scene, canvas.path(path)
        self._length = length
        self._root = scene.add_frame(name, show_axes=False, visible=False)
        self._arrows = {
            key: add_solid(scene, f"{name}/{key}", _arrow(k), colour, scale=length)
            for k, (key, colour) in enumerate(COLOURS.items())
        }
        self._names = {
            key: scene.add_label(f"{name}/name_{key}", key, font_screen_scale=NAME_SCALE, anchor="center-center")
            for key in COLOURS
        }
        self._circle = scene.add_line_segments(f"{name}/circle", arc(np.pi), PURPLE, thickness=CIRCLE * canvas.size)
        self._half = np.pi
        self._place_names()

    def resize(self, length: float) -> None:
        """Set the length of the arrows, metres."""
        if length != self._length:
            self._length = length
            for arrow in self._arrows.values():
                arrow.scale = length
            self._place_names()

    def _place_names(self) -> None:
        for k, name in enumerate(self._names.values()):
            move(name, NAME_AT * np.eye(3)[k] * self._length)

    def show(self, position: Floats, t: Floats, n: Floats, b: Floats, curvature: float) -> None:
        """Show the frame at a position.

        Parameters
        ----------
        position : ndarray, shape (3,)
            Metres in the scene.
        t, n, b : ndarray, shape (3,)
            Unit vectors; zero where not defined, and then not drawn.
        curvature : float
            1/m in the scene; no circle where it is zero.
        """
        seen(self._root, True)
        move(self._root, position)
        there = {"t": bool(t.any()), "n": bool(n.any()), "b": bool(b.any())}
        if there["t"]:
            turn(self._root, np.stack([t, n, b], axis=1) if there["n"] else along(t)[:3, [2, 0, 1]])
        for key, arrow in self._arrows.items():
            seen(arrow, there[key])
            seen(self._names[key], there[key])
        self._show_circle(1.0 / curvature if curvature > 0.0 and there["n"] else 0.0)

    def _show_circle(self, radius: float) -> None:
        drawn = LEAST * self._length <= radius <= LARGEST * self._length
        seen(self._circle, drawn)
        if not drawn:
            return
        half = min(np.pi, ARC * self._length / radius)
        if half != self._half:
            self._half = half
            self._circle.points = arc(half)
        self._circle.scale = radius
        move(self._circle, (0.0, radius, 0.0))

    def hide(self) -> None:
        """Hide the frame."""
        seen(self._root, False)


@cache
def _arrow(k: int) -> Solid:
    """Return an arrow of unit length along axis k."""
    shaft = lathe([(0.0, 0.0), (WIDTH, 0.0), (WIDTH, 0.78), (2.7 * WIDTH, 0.78), (0.0, 1.0)], sides=20)
    return placed(shaft, along(np.eye(3)[k]))


def arc(half: float) -> Segments:
    """Return the part of the unit circle in the plane of t and n up to an angle, radians, from the curve, (k, 2, 3)."""
    angle = np.linspace(-half, half, SIDES + 1)
    return polyline(np.stack([np.sin(angle), -np.cos(angle), np.zeros_like(angle)], axis=1))
