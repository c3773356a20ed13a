"""The errors of the tool, magnified: the body that J predicts, and points by forward kinematics."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.joint.errors import cloud_at, errors_at, magnified
from armlab.benches.drive.joint.state import Drives
from armlab.benches.drive.joint.ui.table import small, times
from armlab.kin.drive.zonotope import outline
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import ORANGE, SKY, VERMILLION, joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Sketch
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.scene._strokes import add_name
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

CORNER, POINT = 0.0055, 0.003
"""Sizes of a corner and of a point inside the box, in sizes of the arm."""

MOST = 512
"""Largest number of corners that are drawn; more of them are thinned out evenly."""

COLOURS = {"corners": VERMILLION, "inside": ORANGE}

OPACITY = 0.3


class _Cloud:
    """The nodes at the tool."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._path = canvas.path("joint_drive")
        self._root = canvas.scene.add_frame(self._path, show_axes=False)
        self._sketch = Sketch(canvas, "joint_drive_marks", 0.8)
        self._scale = add_name(canvas.scene, f"{self._path}/scale", "", (0.0, 0.0, 0.0), "top-center")
        self._body: Any = None
        self._clouds: dict[str, Any] = {}

    def draw(self, state: State, q: Floats) -> None:
        """Draw the errors at a shown configuration."""
        part = state[Drives]
        factor, found = magnified(part), errors_at(part, q)
        tool = np.asarray(part.arm.position(q), dtype=np.float64)
        there = factor > 0.0 and found.position.size > 0.0
        seen(self._root, there)
        if not there:
            self._sketch.draw(Marks())
            return
        move(self._root, tool)
        generators = factor * found.generators
        self._draw_body(generators)
        corners, inside = thinned(cloud_at(part, q), 2**part.arm.n)
        self._draw_points("inside", factor * inside, POINT, part.points)
        self._draw_points("corners", factor * corners, CORNER, part.points)
        worst = factor * found.position.vector
        worst = worst if worst[2] >= 0.0 else -worst
        lines = [(tool - g, tool + g, joint_colour(i)) for i, g in enumerate(generators.T) if np.linalg.norm(g) > 0.0]
        label = f"± {small(units_of(state), found.position.size, False)}"
        self._sketch.draw(Marks([(tool, tool + worst, VERMILLION)], lines, label, tool + worst))
        write(self._scale, f"drawn {times(factor)} times as large")
        low = float(np.abs(generators[2]).sum())
        move(self._scale, (0.0, 0.0, -low - 0.03 * self._canvas.size))

    def _draw_body(self, generators: Floats) -> None:
        if self._body is not None:
            self._body.remove()
            self._body = None
        flat = outline(generators).triangles.reshape(-1, 3)
        if not len(flat):
            return
        self._body = self._canvas.scene.add_mesh_simple(
            f"{self._path}/body",
            flat.astype(np.float32),
            np.arange(len(flat), dtype=np.uint32).reshape(-1, 3),
            color=SKY,
            opacity=OPACITY,
            flat_shading=True,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )

    def _draw_points(self, name: str, points: Floats, size: float, on: bool) -> None:
        cloud = self._clouds.get(name)
        if cloud is not None:
            seen(cloud, on)
        if not on:
            return
        if cloud is None:
            self._clouds[name] = self._canvas.scene.add_point_cloud(
                f"{self._path}/{name}",
                points.astype(np.float32),
                COLOURS[name],
                point_size=size * self._canvas.size,
                point_shape="circle",
                precision="float32",
            )
        else:
            cloud.points = points.astype(np.float32)


def thinned(points: Floats, corners: int) -> tuple[Floats, Floats]:
    """Return the corners, which come first, without some of them where there are very many, and the other points."""
    return points[: corners : -(-corners // MOST)], points[corners:]


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the cloud, which follows the arm."""
    return canvas.follow(state, _Cloud(canvas).draw)


LAYER = Layer(
    "joint_drive",
    order=82,
    watches=(Drives, Joints, Notation, Display),
    build=build,
    panel="joint_drive",
)
