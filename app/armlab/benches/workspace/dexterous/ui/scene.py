"""Orientations in the scene: rings of a planar arm, a coloured slice that can be clicked, or a body of voxels."""

from __future__ import annotations

from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.ui.clicks import SceneClicks
from armlab.benches.workspace.cloud.ui.voxels import VoxelBody, outside
from armlab.benches.workspace.dexterous.picture import Slice, body_shown, slice_shown
from armlab.benches.workspace.dexterous.state import Dexterous, GoToSlice, method_of, rings_alone, study_of
from armlab.benches.workspace.dexterous.ui.rings import Rings
from armlab.benches.workspace.dexterous.ui.words import count_colour
from armlab.kin.workspace.planar import lengths_of
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import viridis
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import put, seen

ALPHA = 214
"""Opacity of a slice, of 255."""

SIDE = 320
"""Least number of pixels along the longer side of a slice, so that its cells keep their edges."""


class _Picture:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas, state: State) -> None:
        self._canvas, self._state = canvas, state
        self._rings: Rings | None = None
        self._frame: viser.FrameHandle | None = None
        self._slice: viser.ImageHandle | None = None
        self._voxels = VoxelBody(canvas, "dexterous/body")
        self._drawn: tuple[object, ...] = ()
        self._shown: Slice | None = None
        self._clicks = SceneClicks(canvas, self._clicked)
        self._planar = lengths_of(canvas.drawn.figure.anatomy.arm) is not None

    def show(self, state: State) -> None:
        """Show a state."""
        self._state = state
        self._show_rings(state)
        part = state[Dexterous]
        drawn = (state.derived(study_of), part.s, part.draw, part.share, method_of(state))
        if drawn != self._drawn:
            self._drawn = drawn
            body = body_shown(state)
            self._shown = None if body is not None else slice_shown(state)
            self._draw_slice(self._shown)
            self._draw_body(body)
        self._clicks.listen(self._shown is not None)

    def _show_rings(self, state: State) -> None:
        """Show the rings: filled if they are valid, else their circles over the samples."""
        if not self._planar:
            return
        if self._rings is None:
            self._rings = Rings(self._canvas)
        self._rings.show(state, bool(state.derived(rings_alone)))

    def _draw_slice(self, shown: Slice | None) -> None:
        if shown is None:
            if self._slice is not None:
                seen(self._slice, False)
            return
        wide, high = (count * shown.step for count in shown.values.shape)
        picture = image(shown.values, method_of(self._state) == "count")
        scene, path = self._canvas.scene, self._canvas.path("dexterous/slice")
        if self._frame is None or self._slice is None:
            # The pose is that of a frame, so that another picture never stands in another place for a moment.
            self._frame = scene.add_frame(path, show_axes=False)
            self._slice = scene.add_image(
                f"{path}/picture", picture, wide, high, format="png", cast_shadow=False, receive_shadow=False
            )
        else:
            self._slice.image = picture
            self._slice.render_width, self._slice.render_height = wide, high
        pose = np.eye(4)
        pose[:3, :3] = np.column_stack([shown.right, shown.up, np.cross(shown.right, shown.up)])
        pose[:3, 3] = shown.corner + 0.5 * wide * shown.right + 0.5 * high * shown.up
        put(self._frame, pose)
        seen(self._slice, True)

    def _draw_body(self, body: NDArray[np.bool_] | None) -> None:
        self._voxels.clear()
        found = self._state.derived(study_of)
        if body is None or found is None or found.wrist is None or not body.any():
            return
        skin, wrist = outside(body), found.wrist
        centres = wrist.low + (np.argwhere(skin) + 0.5) * wrist.step
        self._voxels.draw(centres, wrist.step, viridis(wrist.fraction[skin]))

    def _clicked(self, event: Any) -> None:
        if self._shown is None:
            return
        point = self._shown.met(np.array(event.ray_origin, dtype=float), np.array(event.ray_direction, dtype=float))
        if point is not None:
            x, y, z = point.tolist()
            self._canvas.post(GoToSlice((x, y, z)))


def image(values: NDArray[np.float64], counts: bool) -> NDArray[np.uint8]:
    """Return values (U, V) as a picture (rows, columns, RGBA), its first row the lowest V; NaN is transparent."""
    cells = np.zeros((*values.shape, 4), dtype=np.uint8)
    there = ~np.isnan(values)
    if counts:
        for count in np.unique(values[there]):
            cells[values == count] = (*count_colour(float(count)), ALPHA)
    else:
        cells[there, :3], cells[there, 3] = viridis(values[there]), ALPHA
    times = -(-SIDE // max(values.shape))
    return np.asarray(np.repeat(np.repeat(cells.transpose(1, 0, 2), times, axis=0), times, axis=1))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the picture."""
    return _Picture(canvas, state).show


LAYER = Layer("dexterous", order=82, watches=(Dexterous, Joints, Notation), build=build, panel="dexterous")
