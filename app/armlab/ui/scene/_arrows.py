"""Arcs, arrows and transparent frames that explain a motion; they are moved and resized, not made again."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.colours import AXES, Rgb
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import add_solid, move, put, seen, write

Pose = NDArray[np.float64]

RADIUS = 0.165
LINE, RAY = 0.010, 0.003
TUBE = 0.0085
HEAD, HEAD_WIDTH = 0.05, 0.021
OUTSIDE = 1.2
"""Sizes, in sizes of the arm: radius of an arc, thickness of its line, of its first ray and of the shaft of an arrow,
length and width of heads. The last is the distance of a name, in radii of its arc."""

INSIDE = 0.95
BESIDE = 0.16
"""Distance of the name of a zero turn (in radii) or a zero shift (in sizes of the arm)."""

THIN = 0.62
"""Thickness of the marks of finished moves, relative to the present one; an arrow stays thicker than the line of the
skeleton along it."""

STEP = math.radians(5.0)
LEAST = 1e-6
"""Angle between the points of an arc, which is also the least angle, or length in sizes of the arm, that is drawn."""


class _Mark:
    """Common part of an arc and an arrow: a place, a head and a name. The axis is z of the place."""

    def __init__(self, scene: viser.SceneApi, path: str, colour: Rgb, size: float) -> None:
        self._size = size
        self._node = scene.add_frame(path, show_axes=False)
        self._head = add_solid(scene, f"{path}/head", _cone(), colour, scale=1e-3)
        self._label = scene.add_label(f"{path}/label", "", font_screen_scale=0.9, anchor="center-center")
        self._shown: tuple[float, bool, str] | None = None
        self._pose: Pose | None = None

    def place(self, pose: Pose) -> None:
        """Move it to a place."""
        if self._pose is None or not np.array_equal(pose, self._pose):
            self._pose = pose
            put(self._node, pose)

    def show(self, amount: float, whole: float, strong: bool, name: str) -> None:
        """Show so much of it.

        Parameters
        ----------
        amount : float
            Radians or metres.
        whole : float
            How much it will be at the end: the name stands in the middle of it.
        strong : bool
            Whether it is being made; what is done is thin.
        name : str
            Empty for none.
        """
        drawn = amount if abs(amount) > LEAST * self._least() else 0.0
        if (drawn, strong, name) == self._shown:
            return
        self._shown = drawn, strong, name
        seen(self._head, drawn != 0.0)
        self._draw(drawn, 1.0 if strong else THIN)
        seen(self._label, bool(name))
        if name:
            write(self._label, name)
        move(self._label, self._middle(whole))

    def _least(self) -> float:
        return self._size

    def _draw(self, amount: float, weight: float) -> None:
        raise NotImplementedError

    def _middle(self, whole: float) -> NDArray[np.float64]:
        raise NotImplementedError

    def _put_head(self, scale: float, at: NDArray[np.float64], direction: NDArray[np.float64]) -> None:
        self._head.scale = scale
        put(self._head, along(direction, at))


class Arc(_Mark):
    """A turn about z of its place, counted from x."""

    def __init__(self, scene: viser.SceneApi, path: str, colour: Rgb, size: float) -> None:
        super().__init__(scene, path, colour, size)
        self._radius = RADIUS * size
        # One colour for all points is taken as sRGB; colours point by point would be linear.
        start = np.array([[[0.0, 0.0, 0.0], [self._radius, 0.0, 0.0]]], dtype=np.float32)
        self._line = scene.add_line_segments(f"{path}/line", start, colour, thickness=LINE * size)
        self._ray = scene.add_line_segments(f"{path}/ray", start, colour, thickness=RAY * size)

    def _least(self) -> float:
        return 1.0

    def _draw(self, amount: float, weight: float) -> None:
        seen(self._line, amount != 0.0)
        seen(self._ray, amount != 0.0)
        if amount == 0.0:
            return
        head = min(weight * HEAD * self._size, 0.6 * self._radius * abs(amount))
        until = amount - math.copysign(head / self._radius, amount)
        self._line.points = self._segments(until)
        self._line.thickness = weight * LINE * self._size
        # The head points along the chord of what it covers.
        tip, at = self._at(amount), self._at(until)
        self._put_head(head, at, tip - at)

    def _segments(self, until: float) -> NDArray[np.float32]:
        angles = np.linspace(0.0, until, 2 + int(abs(until) / STEP))
        points = self._radius * np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
        return np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)

    def _at(self, angle: float) -> NDArray[np.float64]:
        return self._radius * np.array([math.cos(angle), math.sin(angle), 0.0])

    def _middle(self, whole: float) -> NDArray[np.float64]:
        return (OUTSIDE if abs(whole) > LEAST else INSIDE) * self._at(0.5 * whole)


class Arrow(_Mark):
    """A shift along z of its place."""

    def __init__(self, scene: viser.SceneApi, path: str, colour: Rgb, size: float) -> None:
        super().__init__(scene, path, colour, size)
        self._label.anchor = "bottom-left"
        self._shaft = add_solid(scene, f"{path}/shaft", _rod(), colour, scale=1e-3)

    def _draw(self, amount: float, weight: float) -> None:
        seen(self._shaft, amount != 0.0)
        if amount == 0.0:
            return
        z = np.array([0.0, 0.0, math.copysign(1.0, amount)])
        head = min(weight * HEAD * self._size, 0.6 * abs(amount))
        width = weight * TUBE * self._size
        self._shaft.scale = (width, width, abs(amount) - head)
        put(self._shaft, along(z))
        self._put_head(head, (abs(amount) - head) * z, z)

    def _middle(self, whole: float) -> NDArray[np.float64]:
        along_axis = 0.5 * whole if abs(whole) > LEAST * self._size else BESIDE * self._size
        return np.array([0.0, 0.0, along_axis])


def pale_frame(scene: viser.SceneApi, path: str, length: float, opacity: float) -> viser.FrameHandle:
    """Return three transparent arrows, a little thicker than those of a solid frame, which fits inside."""
    frame = scene.add_frame(path, show_axes=False)
    for axis, colour in AXES.items():
        solid = _axis("xyz".index(axis))
        add_solid(scene, f"{path}/{axis}", solid, colour, scale=length, opacity=opacity)
    return frame


@cache
def _cone() -> Solid:
    """Return a head of unit length along z, from the origin."""
    return lathe([(0.0, 0.0), (HEAD_WIDTH / HEAD, 0.0), (0.0, 1.0)], sides=24)


@cache
def _rod() -> Solid:
    """Return a cylinder of unit radius and length along z, from the origin."""
    return lathe([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], sides=20)


@cache
def _axis(k: int) -> Solid:
    """Return an arrow of unit length along axis k."""
    width = 0.038
    arrow = lathe([(0.0, 0.0), (width, 0.0), (width, 0.77), (2.6 * width, 0.77), (0.0, 1.02)], sides=20)
    return placed(arrow, along(np.eye(3)[k]))
