"""Two lines with their handles, the common normal with its right angles, and the twist as an arc."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.robot.normal.state import DragLine, Lines
from armlab.kin.lines import CommonNormal, Line
from armlab.kin.rotations import rotation_from_axis_angle, rotation_from_quaternion
from armlab.kin.transforms import transform
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import AXES, BLUE, INK, ORANGE, Rgb, line_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, put, seen, write
from armlab.ui.switches import DARK
from armlab.ui.units import Units, units_of

Array = NDArray[np.float64]

COLOURS: tuple[Rgb, Rgb] = (BLUE, ORANGE)

HALF, ROD, HEAD = 0.24, (0.0045, 0.0036), 0.013
"""Half length of a line, radii of the rods and of their heads, in sizes of the arm; if both lines are the same the
second lies inside the first."""

NORMAL, THIN, CORNER, ARC, HANDLE = 0.009, 0.003, 0.025, 0.13, 0.1
"""Thickness of the normal and of fine lines, side of a right angle, radius of the arc, length of handles, in sizes of
the arm."""

ARC_STEPS, DASHES = 24, 7


class TwoLines:
    """The nodes of both lines and of their connections; a drag moves them without rebuilding them."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas, self._size, self._dark = canvas, canvas.size, False
        self._rods = [self._rod(i) for i in (0, 1)]
        self._normal = self._strokes("normal", AXES["x"], NORMAL)
        self._fine = self._strokes("fine", INK[False], THIN)
        self._arc = self._strokes("arc", AXES["x"], 1.6 * THIN)
        self._a = self._label("a", "bottom-center")
        self._alpha = self._label("alpha", "center-left")
        self._handles = [_Handle(canvas, i) for i in (0, 1)]

    def show(self, state: State) -> None:
        """Show the lines of a state."""
        lines, units = state[Lines], units_of(state)
        normal = lines.normal
        for rod, line in zip(self._rods, (lines.first, lines.second), strict=True):
            put(rod, transform(_frame(line.direction), line.point))
        for handle, line in zip(self._handles, (lines.first, lines.second), strict=True):
            handle.show(line, lines.handle)
        if DARK.on(state) != self._dark:
            self._dark = DARK.on(state)
            self._fine.colors = np.array(INK[self._dark], dtype=np.uint8)
        _draw(self._normal, [normal.foot1, normal.foot2] if normal.a > 0.0 else [])
        _draw(self._fine, self._fine_lines(lines, normal))
        arc = _arc(normal, lines.first.direction, ARC * self._size)
        _draw(self._arc, [point for pair in pairwise(arc) for point in pair])
        self._name(normal, arc, units)

    def _fine_lines(self, lines: Lines, normal: CommonNormal) -> list[Array]:
        """Return the ends of the fine lines: right angles, dashes to the feet, the first direction at the second."""
        size, x = self._size, normal.normal
        points: list[Array] = []
        for line, foot, along in ((lines.first, normal.foot1, x), (lines.second, normal.foot2, -x)):
            points += _beyond(line, foot, HALF * size)
            if normal.kind != "coincident":
                points += _right_angle(foot, along if normal.a > 0.0 else x, line.direction, CORNER * size)
        if normal.a == 0.0:
            points += [normal.foot1, normal.foot1 + ARC * size * x]
        if normal.kind in ("skew", "intersecting"):
            points += _dashed(normal.foot2, normal.foot2 + 1.25 * ARC * size * lines.first.direction)
        return points

    def _name(self, normal: CommonNormal, arc: Array, units: Units) -> None:
        length, twist = f"a = {units.length(normal.a)}", f"α = {units.angle(normal.alpha)}"
        if len(arc) == 0:
            write(self._a, f"{length}, {twist}")
            self._alpha.visible = False
        else:
            write(self._a, length)
            write(self._alpha, twist)
            self._alpha.visible = True
            middle = arc[len(arc) // 2]
            move(self._alpha, normal.foot2 + 1.25 * (middle - normal.foot2))
        at = 0.5 * (normal.foot1 + normal.foot2) if normal.a > 0.0 else normal.foot1 + ARC * self._size * normal.normal
        move(self._a, at)

    # -- making ----------------------------------------------------------------------------------------------------

    def _rod(self, i: int) -> viser.FrameHandle:
        """Return the node of a line along its z: a rod, a head, a name."""
        scene, size, path = self._canvas.scene, self._size, self._canvas.path(f"line{i + 1}")
        node = scene.add_frame(path, show_axes=False)
        scene.add_cylinder(
            f"{path}/rod", radius=ROD[i] * size, height=2.0 * HALF * size, color=COLOURS[i], radial_segments=16
        )
        scene.add_arrows(
            f"{path}/head",
            np.array([[[0.0, 0.0, HALF * size], [0.0, 0.0, (HALF + 3.2 * HEAD) * size]]], dtype=np.float32),
            line_colour(COLOURS[i]),  # arrows take it as linear light, cylinders and line segments do not
            shaft_radius=ROD[i] * size,
            head_radius=HEAD * size,
            head_length=2.8 * HEAD * size,
        )
        scene.add_label(
            f"{path}/name",
            "z₁" if i == 0 else "z₂",
            position=(0.0, 0.0, (HALF + 4.0 * HEAD) * size),
            font_screen_scale=0.9,
            anchor="bottom-center",
        )
        return node

    def _strokes(self, name: str, colour: Rgb, thickness: float) -> viser.LineSegmentsHandle:
        empty = np.zeros((1, 2, 3), dtype=np.float32)
        path = self._canvas.path(f"lines_{name}")
        return self._canvas.scene.add_line_segments(path, empty, colour, thickness=thickness * self._size)

    def _label(self, name: str, anchor: Any) -> viser.LabelHandle:
        path = self._canvas.path(f"lines_{name}_label")
        return self._canvas.scene.add_label(path, "", font_screen_scale=0.9, anchor=anchor)


class _Handle:
    """The handle of one line: arrows that move it, or rings that turn it about its point."""

    def __init__(self, canvas: LayerCanvas, which: int) -> None:
        self._canvas, self._which = canvas, which
        self._mode = ""
        self._control: viser.TransformControlsHandle | None = None
        self._line: Line | None = None
        self._held, self._pulled, self._drag = False, False, object()
        self._began: tuple[Array, Array] = (np.eye(3), np.zeros(3))

    def show(self, line: Line, mode: str) -> None:
        """Move the handle to its line, unless it is dragged."""
        self._line = line
        if self._held:
            return
        if mode != self._mode:
            self._make(mode)
        assert self._control is not None
        put(self._control, transform(np.eye(3), line.point))

    def _make(self, mode: str) -> None:
        if self._control is not None:
            self._control.remove()
        self._mode = mode
        control = self._canvas.scene.add_transform_controls(
            self._canvas.path(f"handle{self._which + 1}_{mode}"),
            scale=HANDLE * self._canvas.size,
            line_width=3.0,
            depth_test=False,
            disable_sliders=True,
            disable_axes=mode == "turn",
            disable_rotations=mode == "move",
        )
        adapter.on_event(control, "on_update", lambda event: self._moved(control, event.phase))
        self._control = control

    def _moved(self, control: viser.TransformControlsHandle, phase: str) -> None:
        assert self._line is not None
        if phase == "start":
            self._held, self._pulled, self._drag = True, False, object()
            self._began = np.asarray(rotation_from_quaternion(control.wxyz), dtype=np.float64), self._line.direction
            return
        if phase == "end":
            self._held = False
            if not self._pulled:
                return  # a mere click
        self._pulled = True
        turned, direction = self._began
        z = rotation_from_quaternion(control.wxyz) @ turned.T @ direction
        self._canvas.post(DragLine(self._which, np.array(control.position), z, self._drag))


def _draw(handle: viser.LineSegmentsHandle, ends: list[Array]) -> None:
    """Show line segments given by their ends, or none."""
    seen(handle, bool(ends))
    if ends:
        handle.points = np.array(ends, dtype=np.float32).reshape(-1, 2, 3)


def _frame(z: Array) -> Array:
    """Return a rotation with the given z."""
    other = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = np.cross(other, z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def _right_angle(foot: Array, x: Array, z: Array, side: float) -> list[Array]:
    return [foot + side * x, foot + side * (x + z), foot + side * (x + z), foot + side * z]


def _beyond(line: Line, foot: Array, half: float) -> list[Array]:
    """Return dashes from the end of the drawn rod to a foot that lies beyond it."""
    t = float((foot - line.point) @ line.direction)
    if abs(t) <= half:
        return []
    return _dashed(line.point + np.sign(t) * half * line.direction, foot)


def _dashed(start: Array, end: Array) -> list[Array]:
    marks = np.linspace(0.0, 1.0, 2 * DASHES)
    return [start + mark * (end - start) for mark in marks]


def _arc(normal: CommonNormal, z: Array, radius: float) -> Array:
    """Return points of an arc about the second foot from the first to the second direction; none for parallel lines."""
    if normal.kind in ("parallel", "coincident"):
        return np.zeros((0, 3))
    turns = rotation_from_axis_angle(normal.normal, np.linspace(0.0, normal.alpha, ARC_STEPS + 1))
    return np.asarray(normal.foot2 + radius * (turns @ z))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the lines of the page Common normal."""
    return TwoLines(canvas).show


LAYER = Layer("normal", order=67, watches=(Lines, Notation, Display), build=build, panel="normal")
