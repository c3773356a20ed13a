"""The curve the tool point traces when one joint alone moves from limit to limit and the others stay.

The curve of a joint keeps its shape: an arc as long as the joint's range, or a line as long as its stroke. So it is
made once, and every pose only moves, turns and scales it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.sweeps import arc, sweeps
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, turn, write
from armlab.ui.scene._strokes import Segments, add_line, add_name, polyline
from armlab.ui.switches import Switch
from armlab.ui.units import units_of

THICKNESS = 0.0042
SMALLEST = 0.012
"""Thickness of the curves, which is also the least radius that is drawn, in sizes of the arm."""

TAG, TAG_TURN = 0.3, 1.9
"""Distance of the name of a joint from the tool along its curve, in sizes of the arm, and at most in radians."""


class _Curves:
    """The curves of all joints."""

    def __init__(self, canvas: LayerCanvas) -> None:
        scene, size, path = canvas.scene, canvas.size, canvas.path("swept")
        self._size, self._arm = size, canvas.drawn.figure.anatomy.arm
        scene.add_frame(path, show_axes=False)
        self._lines = [
            add_line(scene, f"{path}/{i + 1}", self._shape(i), joint_colour(i), size, THICKNESS)
            for i in range(self._arm.n)
        ]
        self._names = [
            add_name(scene, f"{path}/name{i + 1}", "", (0.0, 0.0, 0.0), "center-center") for i in range(self._arm.n)
        ]

    def _shape(self, i: int) -> Segments:
        """Return the arc of unit radius, or the line, over the range of joint i (0-based)."""
        low, high = self._arm.limits[i]
        if not self._arm.revolute[i]:
            return polyline([[0.0, 0.0, low], [0.0, 0.0, high]])
        c, s = np.cos(low), np.sin(low)
        back = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        return polyline(arc(high - low) @ back)

    def name(self, state: State) -> None:
        """Write the names of the joints."""
        units = units_of(state)
        for i, name in enumerate(self._names):
            write(name, f"{units.variable(i, bool(self._arm.revolute[i]))} alone")

    def _tags(self, q: NDArray[np.float64], radius: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the joint values at which their names stand, alternately on either side of the tool."""
        way = TAG * self._size
        step = np.where(self._arm.revolute, np.minimum(way / np.maximum(radius, SMALLEST * self._size), TAG_TURN), way)
        step[1::2] *= -1.0
        inside = (q + step >= self._arm.limits[:, 0]) & (q + step <= self._arm.limits[:, 1])
        return np.array(self._arm.clip(q + np.where(inside, step, -step)), dtype=float)

    def follow(self, q: NDArray[np.float64]) -> None:
        """Move all curves to their places in a shown configuration."""
        found = sweeps(self._arm, q)
        tags = found.at(self._tags(q, found.radius))
        for i, (line, name) in enumerate(zip(self._lines, self._names, strict=True)):
            drawn = not found.revolute[i] or float(found.radius[i]) > SMALLEST * self._size
            seen(line, drawn)
            seen(name, drawn)
            if not drawn:
                continue
            if found.revolute[i]:
                line.scale = float(found.radius[i])
            move(line, found.centre[i])
            turn(line, found.axes[i])
            move(name, tags[i])


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the curves, which follow the pose."""
    curves = _Curves(canvas)
    curves.follow(canvas.shown_pose)
    canvas.on_pose(curves.follow)

    def show(state: State) -> None:
        curves.name(state)
        curves.follow(canvas.shown_pose)  # it may have moved while they were hidden

    return show


SWITCH = Switch(
    "swept", "Swept curves", "What the tool point would trace if one joint alone moved from limit to limit.", "U"
)
LAYER = Layer("swept", order=84, watches=(Notation,), build=build, switch=SWITCH, silent=True)
