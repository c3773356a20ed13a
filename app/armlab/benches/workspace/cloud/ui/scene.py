"""The sampled workspace in the scene: points or voxels, coloured by a measure; a click on one chooses it."""

from __future__ import annotations

from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import GoToSample, Workspace
from armlab.benches.workspace.cloud.ui import measured
from armlab.benches.workspace.cloud.ui.clicks import SceneClicks
from armlab.benches.workspace.cloud.ui.voxels import VoxelBody, outside
from armlab.benches.workspace.cloud.view import boundary, drawing, kept, left_of, pointed_at
from armlab.kin.workspace.surface import Surface
from armlab.session.state import State
from armlab.ui.colours import SKY, VERMILLION, viridis
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen

POINT = 0.0046
"""Diameter of a point, in sizes of the arm."""

CHOSEN = 0.02
"""Diameter of the chosen point, in sizes of the arm."""

OPACITY = 0.3
"""Opacity of the surface, through which the arm is seen."""


def parts_of(found: Sampled, values: NDArray[Any]) -> NDArray[np.float64]:
    """Return the places of values on the scale of colours, 0 to 1."""
    return measured.parts_of(found.question.measure, found.low, found.high, values)


class _Picture:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas, state: State) -> None:
        self._canvas, self._state = canvas, state
        self._cloud: viser.PointCloudHandle | None = None
        self._voxels = VoxelBody(canvas, "workspace/voxels")
        self._surface: viser.MeshHandle | None = None
        self._mark: viser.IcosphereHandle | None = None
        self._shown: tuple[object, ...] = ()
        self._clicks = SceneClicks(canvas, self._clicked)

    def show(self, state: State) -> None:
        """Show a state."""
        self._state = state
        part = state[Workspace]
        found = part.found
        self._clicks.listen(found is not None and part.clicks)
        shown = (found, part.draw, part.cut, part.offset, part.edge, part.section)
        if shown != self._shown:
            self._shown = shown
            # Points stay until there is a surface to see.
            draw = drawing(state)
            waits = draw == "surface" and part.section is None
            self._draw_points(found if draw == "cloud" or waits else None)
            self._draw_voxels(found if draw == "voxels" else None)
            self._draw_surface(boundary(state) if draw == "surface" else None)
        self._draw_chosen(found, part.chosen)

    def _draw_points(self, found: Sampled | None) -> None:
        left = self._state.derived(kept)
        drawn = found is not None and bool(left.any())
        if self._cloud is not None:
            seen(self._cloud, drawn)
        if found is None or not drawn:
            return
        points = found.shown.points[left]
        colours = viridis(parts_of(found, found.shown.values[left]))
        if self._cloud is not None:
            self._cloud.points, self._cloud.colors = points, colours
            return
        self._cloud = self._canvas.scene.add_point_cloud(
            self._canvas.path("workspace/points"),
            points,
            colours,
            point_size=POINT * self._canvas.size,
            point_shape="circle",
            precision="float32",
        )

    def _draw_voxels(self, found: Sampled | None) -> None:
        self._voxels.clear()
        if found is None:
            return
        left = found.voxels.count > 0
        left[left] = left_of(self._state, found.voxels.centres(left))
        left = outside(left)
        if left.any():
            colours = viridis(parts_of(found, found.voxels.mean()[left]))
            self._voxels.draw(found.voxels.centres(left), found.voxels.step, colours)

    def _draw_surface(self, drawn: Surface | None) -> None:
        if self._surface is not None:
            self._surface.remove()
            self._surface = None
        if drawn is not None and len(drawn.faces):
            self._surface = self._canvas.scene.add_mesh_simple(
                self._canvas.path("workspace/surface"),
                drawn.vertices.astype(np.float32),
                drawn.faces.astype(np.uint32),
                color=SKY,
                opacity=OPACITY,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )

    def _draw_chosen(self, found: Sampled | None, chosen: int | None) -> None:
        drawn = found is not None and chosen is not None and chosen < len(found.shown.points)
        if self._mark is None and drawn:
            self._mark = self._canvas.scene.add_icosphere(
                self._canvas.path("workspace/chosen"),
                radius=0.5 * CHOSEN * self._canvas.size,
                color=VERMILLION,
                subdivisions=2,
                cast_shadow=False,
                receive_shadow=False,
            )
        if self._mark is not None:
            seen(self._mark, drawn)
        if self._mark is not None and found is not None and chosen is not None and drawn:
            move(self._mark, found.shown.points[chosen])

    def _clicked(self, event: Any) -> None:
        index = pointed_at(self._state, event.ray_origin, event.ray_direction)
        if index is not None:
            self._canvas.post(GoToSample(index))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the picture."""
    return _Picture(canvas, state).show


LAYER = Layer("workspace", order=80, watches=(Workspace,), build=build, panel="workspace")
