"""Two workspaces in the scene: kept, gained and lost points, and the supposed arm."""

from __future__ import annotations

from typing import Literal

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.workspace.what_if.state import WhatIf
from armlab.benches.workspace.what_if.view import parts_of, thought_pose
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import GREEN, GREY, ORANGE, VERMILLION, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import seen
from armlab.ui.scene._sticks import corners_of
from armlab.ui.scene._strokes import add_line, polyline

COLOURS: dict[str, Rgb] = {"kept": GREY, "thought": ORANGE, "gained": GREEN, "lost": VERMILLION}
"""Colours of points in both workspaces, of points that may be in one only, of gained and of lost points."""

THOUGHT = ORANGE
"""Colour of the supposed arm."""

SIZES = {"kept": 0.0034, "thought": 0.0046, "gained": 0.0058, "lost": 0.0058}
"""Diameter of a point, in sizes of the arm; gained and lost points are larger."""

PRECISION: Literal["float16"] = "float16"
"""Precision of points sent to the page: a millimetre in two metres, while a slider moves many of them."""

LINE = 0.008
"""Thickness of the supposed arm, in sizes of the arm."""


class _Picture:
    """Four clouds and a line."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._clouds: dict[str, viser.PointCloudHandle] = {}
        self._drawn: object = None
        nothing = np.zeros((1, 2, 3), dtype=np.float32)
        self._line = add_line(canvas.scene, canvas.path("what_if/arm"), nothing, THOUGHT, canvas.size, LINE)

    def show(self, state: State) -> None:
        """Show a state."""
        found = state[WhatIf].found
        if found is not self._drawn:
            self._drawn = found
            for name, points in state.derived(parts_of)._asdict().items():
                self._draw(name, points)
        q = state.derived(thought_pose)
        seen(self._line, q is not None)
        if q is not None:
            self._line.points = polyline(corners_of(state[WhatIf].other, q[None])[0])

    def _draw(self, name: str, points: NDArray[np.float32]) -> None:
        cloud = self._clouds.get(name)
        if cloud is not None:
            seen(cloud, bool(len(points)))
        if not len(points):
            return
        if cloud is None:
            self._clouds[name] = self._canvas.scene.add_point_cloud(
                self._canvas.path(f"what_if/{name}"),
                points,
                COLOURS[name],
                point_size=SIZES[name] * self._canvas.size,
                point_shape="circle",
                precision=PRECISION,
            )
        elif not np.array_equal(cloud.points, points.astype(cloud.points.dtype)):
            cloud.points = points


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the picture."""
    return _Picture(canvas).show


LAYER = Layer("what_if", order=81, watches=(WhatIf, Joints), build=build, panel="what_if")
