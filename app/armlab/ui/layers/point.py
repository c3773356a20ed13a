"""Frame 0, the world's and the tool's frame, and the tool point with its place in the world."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.point import Point, Xyz, world_point
from armlab.session.state import State
from armlab.ui.colours import VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH, frame_glb
from armlab.ui.layers.frames import SWITCH as FRAMES
from armlab.ui.plugin import Layer, Show
from armlab.ui.units import units_of

RADIUS, THICKNESS = 0.011, 0.003
"""Of the point and of the line to it, in sizes of the arm."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the marks; the tool's move with its body."""
    anatomy = canvas.drawn.figure.anatomy
    arm, tool, n = anatomy.arm, anatomy.tool_on_last(), len(anatomy.bodies)
    at_world = bool(np.array_equal(arm.base, np.eye(4)))
    ends = _frame(canvas, canvas.path("frame_0"), arm.base, "{w, 0}" if at_world else "{0}")
    if not at_world:
        _frame(canvas, canvas.path("frame_w"), np.eye(4), "{w}")
    hand = _frame(canvas, f"{canvas.node(n)}/frame_E", tool, "{E}")
    ball = canvas.scene.add_icosphere(
        f"{canvas.node(n)}/point", RADIUS * canvas.size, VERMILLION, cast_shadow=False, receive_shadow=False
    )
    label = canvas.scene.add_label(
        f"{canvas.node(n)}/point_label", "", font_screen_scale=0.85, anchor="top-left", depth_test=False
    )
    line: viser.LineSegmentsHandle | None = None
    placed: Xyz | None = None

    def place(xyz: Xyz) -> None:
        nonlocal line, placed
        placed = xyz
        end = (tool @ [*xyz, 1.0])[:3]
        ball.position = label.position = end
        if line is not None:
            line.remove()
            line = None
        if any(xyz):
            points = np.array([[tool[:3, 3], end]], dtype=np.float32)
            line = canvas.scene.add_line_segments(
                f"{canvas.node(n)}/point_line", points, VERMILLION, thickness=THICKNESS * canvas.size
            )

    def show(state: State) -> None:
        if placed != state[Point].xyz:
            place(state[Point].xyz)
        alone = not FRAMES.on(state)
        for handle, on in (
            (ends[0], alone),
            (ends[1], alone),
            (hand[0], alone),
            (hand[1], alone and any(placed or ())),
        ):
            if handle.visible != on:
                handle.visible = on
        text = _told(state)
        if label.text != text:
            label.text = text

    return show


def _frame(
    canvas: LayerCanvas, name: str, pose: NDArray[np.float64], label: str
) -> tuple[viser.GlbHandle, viser.LabelHandle]:
    """Draw a frame with its label; ``name`` says on which body."""
    mark = canvas.scene.add_glb(
        name,
        frame_glb(),
        scale=FRAME_LENGTH * canvas.size,
        wxyz=quaternion_from_rotation(pose[:3, :3]),
        position=pose[:3, 3],
        cast_shadow=False,
        receive_shadow=False,
    )
    corner = 0.35 * FRAME_LENGTH * canvas.size * (pose[:3, 0] + pose[:3, 1])
    text = canvas.scene.add_label(f"{name}_label", label, position=pose[:3, 3] + corner, font_screen_scale=0.85)
    return mark, text


def _told(state: State) -> str:
    units = units_of(state)
    x, y, z = (units.text(float(value), False) for value in world_point(state))
    return f"p = ({x}, {y}, {z}) {units.length_unit}"


LAYER = Layer("point", order=65, watches=(Joints, Point, Notation, Display), build=build, panel="table")
