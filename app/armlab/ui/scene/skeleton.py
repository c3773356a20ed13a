"""The arm as in textbooks: lines along the lengths of the table, a cylinder or a box for each joint."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import viser

from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui.colours import INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.anatomy import Pose
from armlab.ui.figure.figure import Figure
from armlab.ui.figure.marks import symbol_height
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._strokes import Segments
from armlab.ui.switches import DARK, SKELETON

PLATE = (110, 119, 132)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach lines and symbols to the bodies, and a plate to the ground, in place of the solids."""
    anatomy, scene = canvas.drawn.figure.anatomy, canvas.scene
    _plate(canvas)
    lines = [(0, np.array([[[0.0, 0.0, canvas.drawn.figure.foot], [0.0, 0.0, 0.0]]], dtype=np.float32))]
    for i in range(len(anatomy.bodies)):
        on, pose = _place_of_symbol(canvas.drawn.figure, i)
        scene.add_glb(
            f"{canvas.node(on)}/symbol{i + 1}",
            canvas.drawn.symbols[i],
            wxyz=quaternion_from_rotation(pose[:3, :3]),
            position=pose[:3, 3],
        )
        segments = _segments(canvas, i)
        if len(segments):
            lines.append((i + 1, segments))

    def show(state: State) -> None:
        for on, segments in lines:
            # Lines are made anew because their colour follows the theme.
            scene.add_line_segments(
                f"{canvas.node(on)}/lines",
                segments,
                INK[DARK.on(state)],
                thickness=0.008 * canvas.size,
            )

    return show


def _plate(canvas: LayerCanvas) -> viser.CylinderHandle:
    """Return the plate on which the arm stands."""
    radius = 2.2 * float(canvas.drawn.figure.anatomy.radius[0])
    return canvas.scene.add_cylinder(
        f"{canvas.node(0)}/plate",
        radius=radius,
        height=0.08 * radius,
        color=PLATE,
        position=(0.0, 0.0, canvas.drawn.figure.foot + 0.04 * radius),
    )


def _place_of_symbol(figure: Figure, i: int) -> tuple[int, Pose]:
    """Return the body that carries the symbol of joint i, and the symbol's pose in that body's node.

    The symbol of a prismatic joint stays with the body before, that of a revolute one turns. It stands where a textbook
    puts it: in the middle of a long offset, and on the ground rather than through it.
    """
    body, height = figure.anatomy.bodies[i], symbol_height(figure.anatomy, i)
    pose = np.array(np.eye(4) if body.revolute else body.mount)
    if body.revolute and abs(body.d) > height:
        pose[:3, 3] += 0.5 * body.d * pose[:3, 2]
    elif i == 0:
        pose[:3, 3] += max(0.0, 0.5 * height + figure.foot) * pose[:3, 2]
    return (i + 1 if body.revolute else i), pose


def _segments(canvas: LayerCanvas, i: int) -> Segments:
    """Return the lines of body i in its node, (k, 2, 3): along z, along x, and to the tool at the last body."""
    anatomy = canvas.drawn.figure.anatomy
    body = anatomy.bodies[i]
    points = [np.zeros(3), np.array([0.0, 0.0, body.d]), np.array([body.a, 0.0, body.d])]
    if i == len(anatomy.bodies) - 1:
        points.append(anatomy.tool_on_last()[:3, 3])
    strokes = list(pairwise(points))
    if not body.revolute:
        # The rod is as long as the full stroke; it reaches back into its box, ahead where the travel is negative.
        ends = -max(body.offset + body.high, 0.0), max(-body.offset - body.low, 0.0)
        strokes += [(np.array([0.0, 0.0, end]), np.zeros(3)) for end in ends]
    pairs = np.array(strokes)
    long_enough = np.linalg.norm(pairs[:, 0] - pairs[:, 1], axis=1) > 1e-6 * canvas.size
    drawn: Segments = pairs[long_enough].astype(np.float32)
    return drawn


LAYER = Layer("skeleton", order=30, watches=(Display,), build=build, switch=SKELETON, silent=True)
