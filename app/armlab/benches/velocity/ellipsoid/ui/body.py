"""The nodes of one ellipsoid: a transparent body, its principal axes and ellipses, and their lengths."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import INK, VERDICT, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._nodes import move, seen, turn, write

Array = NDArray[np.float64]

AXIS, RIM, DASH = 0.0045, 0.0022, 0.0045
"""Thickness of lines, in sizes of the arm."""

LOST = 0.16
"""Half length of the dashed line along which there is no speed, in sizes of the arm."""

LONGEST = 0.45
"""Longest half axis of forces that is drawn, in sizes of the arm; a longer or infinite one has this length, and a line
through it."""

BEYOND = 0.6
"""Half length of the line through a half axis that is cut, in sizes of the arm."""

THINNEST = 0.001
"""Half thickness of a flat body, in sizes of the arm; a scale of 0 would have no normals."""

WRITTEN = 0.3
"""Distance from the centre at which the length of a half axis is written, in sizes of the arm."""

SIDES = 48
DASHES = 9


class Colours(NamedTuple):
    """Colours of the body, of its ellipses, and of the lines for special directions."""

    body: Rgb
    rims: Rgb
    lines: Rgb


class Half(NamedTuple):
    """One half axis.

    Attributes
    ----------
    length : float
        Metres in the scene; infinite for an endless one.
    text : str
        What stands at its tip; empty for an axis that the task does not have.
    lost : bool
        Whether a dashed line says that there is nothing along it.
    """

    length: float
    text: str
    lost: bool = False


class Body:
    """One ellipsoid; a change of the pose moves and scales the nodes without rebuilding them.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
        Of its node.
    colours : Colours
    end : 1 or -1
        At which ends of the axes the lengths stand: 1 for the upper ones, -1 for those away from the arm.
    longest : float
        Half axis that is drawn at most, in sizes of the arm.
    """

    def __init__(
        self, canvas: LayerCanvas, name: str, colours: Colours, end: int = 1, longest: float = math.inf
    ) -> None:
        scene, size, path = canvas.scene, canvas.size, canvas.path(name)
        self._size, self._end, self._ink, self._longest = size, end, False, longest * size
        self._origin = canvas.drawn.figure.anatomy.root[:3, 3]
        self._root = scene.add_frame(path, show_axes=False)
        self._body = scene.add_icosphere(
            f"{path}/body", color=colours.body, subdivisions=4, opacity=0.22, cast_shadow=False, receive_shadow=False
        )
        self._rims = scene.add_line_segments(f"{path}/rims", _circles(), colours.rims, thickness=RIM * size)
        self._axes = scene.add_line_segments(f"{path}/axes", _axes(), INK[False], thickness=AXIS * size)
        self._lost = [
            scene.add_line_segments(
                f"{path}/lost{i}", _dashes(i), VERDICT["no"], thickness=DASH * size, scale=LOST * size, visible=False
            )
            for i in range(3)
        ]
        self._through = [
            scene.add_line_segments(
                f"{path}/through{i}",
                _axes()[i : i + 1],
                colours.lines,
                thickness=1.4 * AXIS * size,
                scale=BEYOND * size,
                visible=False,
            )
            for i in range(3)
        ]
        self._labels = [
            scene.add_label(f"{path}/sigma{i}", "", font_screen_scale=0.85, anchor="bottom-center") for i in range(3)
        ]
        self._scale = scene.add_label(f"{path}/scale", "", font_screen_scale=0.8, anchor="top-center")

    def visible(self, on: bool) -> None:
        """Show or hide the whole ellipsoid."""
        seen(self._root, on)

    def ink(self, dark: bool) -> None:
        """Draw the axes in the colour that is visible in the theme."""
        if dark != self._ink:
            self._ink = dark
            self._axes.colors = np.array(INK[dark], dtype=np.uint8)

    def say(self, scale: str) -> None:
        """Write the scale of the drawing."""
        write(self._scale, scale)

    def place(self, centre: Array, axes: Array, halves: Sequence[Half]) -> None:
        """Place the ellipsoid.

        Parameters
        ----------
        centre : ndarray, shape (3,)
        axes : ndarray, shape (3, 3)
            A rotation, whose columns are the principal axes in the world.
        halves : sequence of Half
            Three of them.
        """
        size = self._size
        a, b, c = (min(max(half.length, THINNEST * size), self._longest) for half in halves)
        turn(self._root, axes)
        move(self._root, centre)
        self._body.scale = self._rims.scale = self._axes.scale = (a, b, c)
        tips = [self._tip(i, half, drawn) for i, (half, drawn) in enumerate(zip(halves, (a, b, c), strict=True))]
        for i, half in enumerate(halves):
            up = self._side(axes[:, i], centre)
            seen(self._lost[i], half.lost)
            seen(self._through[i], half.length > self._longest)
            seen(self._labels[i], bool(half.text))
            write(self._labels[i], half.text)
            side = np.zeros(3)
            side[i] = up * tips[i]
            move(self._labels[i], side)
            if i == self._named(halves):
                move(self._scale, -side)

    def _side(self, axis: Array, centre: Array) -> float:
        """Return the end of an axis at which its length is written: the upper one, or the one away from the arm."""
        if self._end < 0 and abs(float(axis[2])) < 0.5:
            return 1.0 if float(axis @ (centre - self._origin)) >= 0.0 else -1.0
        return self._end if axis[2] >= -1e-9 else -self._end

    def _tip(self, i: int, half: Half, drawn: float) -> float:
        """Return the distance from the centre at which the length is written."""
        if half.lost:
            return LOST * self._size
        return WRITTEN * self._size if half.length > self._longest else drawn

    def _named(self, halves: Sequence[Half]) -> int:
        """Return the axis at whose other end the scale is written: the longest one that is not cut."""
        lengths = [half.length if half.text and half.length <= self._longest else -1.0 for half in halves]
        return int(np.argmax(lengths))


def _circles() -> NDArray[np.float32]:
    """Return unit circles in the three planes, (k, 2, 3)."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    rings = [np.roll(circle, shift, axis=1) for shift in range(3)]
    return np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings]).astype(np.float32)


def _axes() -> NDArray[np.float32]:
    """Return the axes from -1 to 1, (3, 2, 3)."""
    return np.stack([-np.eye(3), np.eye(3)], axis=1).astype(np.float32)


def _dashes(i: int) -> NDArray[np.float32]:
    """Return a dashed line along axis i from -1 to 1, (k, 2, 3)."""
    ends = np.linspace(-1.0, 1.0, 2 * DASHES)
    points = np.zeros((2 * DASHES, 3), dtype=np.float32)
    points[:, i] = ends
    return points.reshape(DASHES, 2, 3)
