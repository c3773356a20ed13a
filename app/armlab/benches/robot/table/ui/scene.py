"""Frame 0, the world's and the tool's frame, and the tool point with its place in the world."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.robot.table.state import Point, Xyz, world_point
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import add_triad, move, put, seen, write
from armlab.ui.scene.frames import SWITCH as FRAMES
from armlab.ui.units import units_of

RADIUS, THICKNESS = 0.011, 0.003
"""Radius of the point, and thickness of the line to it, in sizes of the arm."""


class _Mark:
    """The tool point: a ball with its place in the world, and a line to it from the tool's frame."""

    def __init__(self, canvas: LayerCanvas) -> None:
        anatomy, scene = canvas.drawn.figure.anatomy, canvas.scene
        self._path = f"{canvas.node(len(anatomy.bodies))}/point"
        self._canvas, self._tool = canvas, anatomy.tool_on_last()
        self._ball = scene.add_icosphere(
            self._path, RADIUS * canvas.size, VERMILLION, cast_shadow=False, receive_shadow=False
        )
        self._label = scene.add_label(
            f"{self._path}_label", "", font_screen_scale=0.85, anchor="top-left", depth_test=False
        )
        self._line: viser.LineSegmentsHandle | None = None
        self._placed: Xyz | None = None

    def show(self, state: State) -> None:
        """Show the point of a state."""
        if self._placed != state[Point].xyz:
            self._place(state[Point].xyz)
        write(self._label, _told(state))

    def _place(self, xyz: Xyz) -> None:
        self._placed = xyz
        end = (self._tool @ [*xyz, 1.0])[:3]
        move(self._ball, end)
        move(self._label, end)
        if self._line is not None:
            self._line.remove()
            self._line = None
        if any(xyz):
            points = np.array([[self._tool[:3, 3], end]], dtype=np.float32)
            self._line = self._canvas.scene.add_line_segments(
                f"{self._path}_line", points, VERMILLION, thickness=THICKNESS * self._canvas.size
            )


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the marks; those of the tool move with its body."""
    anatomy = canvas.drawn.figure.anatomy
    base = anatomy.arm.base
    at_world = bool(np.array_equal(base, np.eye(4)))
    ends = _frame(canvas, canvas.path("frame_0"), base, "{w, 0}" if at_world else "{0}")
    if not at_world:
        _frame(canvas, canvas.path("frame_w"), np.eye(4), "{w}")
    hand, name = _frame(canvas, f"{canvas.node(len(anatomy.bodies))}/frame_E", anatomy.tool_on_last(), "{E}")
    mark = _Mark(canvas)

    def show(state: State) -> None:
        mark.show(state)
        alone = not FRAMES.on(state)
        for handle in (*ends, hand):
            seen(handle, alone)
        seen(name, alone and any(state[Point].xyz))  # the name of the point is there else

    return show


def _frame(
    canvas: LayerCanvas, name: str, pose: NDArray[np.float64], label: str
) -> tuple[viser.GlbHandle, viser.LabelHandle]:
    """Draw a frame with its label; ``name`` tells on which body."""
    mark = add_triad(canvas.scene, name, canvas.size)
    put(mark, pose)
    corner = 0.35 * FRAME_LENGTH * canvas.size * (pose[:3, 0] + pose[:3, 1])
    text = canvas.scene.add_label(f"{name}_label", label, position=pose[:3, 3] + corner, font_screen_scale=0.85)
    return mark, text


def _told(state: State) -> str:
    units = units_of(state)
    x, y, z = (units.text(float(value), False) for value in world_point(state))
    return f"p = ({x}, {y}, {z}) {units.length_unit}"


LAYER = Layer("point", order=65, watches=(Joints, Point, Notation, Display), build=build, panel="table")
