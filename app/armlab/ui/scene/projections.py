"""The coordinates of the tool point in frame 0: strokes along the axes, and dashed lines from the point to them."""

from __future__ import annotations

import math

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.transforms import inverse
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import AXES, FINE_INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.scene._strokes import THICK, add_line, add_name, dashes, polyline, stretch
from armlab.ui.switches import DARK, Switch
from armlab.ui.units import Units, units_of

PERIOD = 0.035
"""Approximate period of the dashes, in sizes of the arm."""

SMALLEST = 0.004
"""Smallest coordinate that is drawn, in sizes of the arm."""


def is_flat(arm: Arm, size: float) -> bool:
    """Return whether the tool point of an arm is always in the plane of x and y of frame 0, and its task too."""
    if arm.task.position != "xy" or not arm.description.axes_parallel or not np.all(arm.revolute):
        return False
    height = (inverse(arm.base) @ arm.fk(np.zeros(arm.n)))[2, 3]
    return abs(float(height)) <= SMALLEST * size


class _Box:
    """The strokes, each a line of unit length that is scaled and moved."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._scene, self._size, self._path = canvas.scene, canvas.size, canvas.path("projections")
        self._arm = canvas.drawn.figure.anatomy.arm
        base = self._arm.base
        self._into_base = np.array(inverse(base))
        self._flat = is_flat(self._arm, self._size)
        self._scene.add_frame(
            self._path, show_axes=False, wxyz=quaternion_from_rotation(base[:3, :3]), position=base[:3, 3]
        )
        self._strokes = {axis: self._stroke(axis) for axis in ("xy" if self._flat else "xyz")}
        self._names = {
            axis: add_name(self._scene, f"{self._path}/name_{axis}", "", (0.0, 0.0, 0.0), anchor)
            for axis, anchor in (("x", "top-center"), ("y", "top-center"), ("r" if self._flat else "z", "center-left"))
        }
        self._drops: dict[str, viser.LineSegmentsHandle] = {}
        self._made: dict[str, tuple[int, bool, bool]] = {}
        self._units = Units(Notation())
        self._point = np.zeros(3)

    def _stroke(self, axis: str) -> viser.LineSegmentsHandle:
        unit = np.eye(3)["xyz".index(axis)]
        return add_line(
            self._scene, f"{self._path}/{axis}", polyline([np.zeros(3), unit]), AXES[axis], self._size, THICK
        )

    def ink(self, dark: bool) -> None:
        """Make the dashed lines, in the colour of the theme."""
        self._made.clear()
        for name in ("to_x", "to_y", "r") if self._flat else ("to_x", "to_y"):
            path = f"{self._path}/{name}"
            self._drops[name] = add_line(self._scene, path, polyline(np.eye(3)[:2]), FINE_INK[dark], self._size)

    def name(self, units: Units) -> None:
        """Write the values."""
        self._units = units
        x, y, z = self._point.tolist()
        for axis, name in self._names.items():
            value = {"x": x, "y": y, "z": z, "r": math.hypot(x, y)}[axis]
            write(name, f"{axis} {units.length(value)}")

    def follow(self, q: NDArray[np.float64]) -> None:
        """Draw the coordinates of a shown configuration."""
        self._point = self._into_base[:3, :3] @ self._arm.position(q) + self._into_base[:3, 3]
        x, y, z = self._point.tolist()
        small = SMALLEST * self._size
        self._stretch(self._strokes["x"], (x, 0.0, 0.0), abs(x) > small)
        self._stretch(self._strokes["y"], (0.0, y, 0.0), abs(y) > small)
        self._drop("to_x", (0.0, y), (x, 0.0, 0.0))
        self._drop("to_y", (x, 0.0), (0.0, y, 0.0))
        if self._flat:
            self._drop("r", (x, y), (0.0, 0.0, 0.0))
            move(self._names["r"], (0.5 * x, 0.5 * y, 0.0))
        else:
            self._stretch(self._strokes["z"], (0.0, 0.0, z), abs(z) > small)
            move(self._strokes["z"], (x, y, 0.0))
            move(self._names["z"], (x, y, 0.5 * z))
        move(self._names["x"], (x, 0.0, 0.0))
        move(self._names["y"], (0.0, y, 0.0))
        self.name(self._units)

    @staticmethod
    def _stretch(line: viser.LineSegmentsHandle, factors: tuple[float, float, float], on: bool) -> None:
        seen(line, on)
        if on:
            stretch(line, factors)

    def _drop(self, name: str, along: tuple[float, float], at: tuple[float, float, float]) -> None:
        """Draw a dashed line in a plane: it is stretched, and made again when another number of dashes fits better.

        It can be stretched along no axis of which it has no part.
        """
        line, length = self._drops[name], math.hypot(*along)
        on = length > SMALLEST * self._size
        seen(line, on)
        if not on:
            return
        made = max(2, round(length / (PERIOD * self._size))), along[0] != 0.0, along[1] != 0.0
        if self._made.get(name) != made:
            self._made[name] = made
            count, *axes = made
            line.points = dashes(np.zeros(3), [*map(float, axes), 0.0], count)
        stretch(line, (*along, 0.0))
        move(line, at)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the coordinates, which follow the pose."""
    box = _Box(canvas)
    dark: bool | None = None

    def show(state: State) -> None:
        nonlocal dark
        if dark != DARK.on(state):
            dark = DARK.on(state)
            box.ink(dark)
        box.name(units_of(state))
        box.follow(canvas.shown_pose)  # it may have moved while they were hidden

    canvas.on_pose(box.follow)
    return show


SWITCH = Switch("projections", "Projections", "The coordinates of the tool point along the axes of frame {0}.", "P")
LAYER = Layer("projections", order=83, watches=(Notation, Display), build=build, switch=SWITCH)
