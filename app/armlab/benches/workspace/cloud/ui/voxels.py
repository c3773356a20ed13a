"""Voxels in the scene: one batch of boxes of one size."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.ui.colours import linear
from armlab.ui.drawing import LayerCanvas

FILLED = 0.94
"""Side of a drawn voxel, relative to the true one: the gaps separate them."""

CORNERS = np.array(list(np.ndindex(2, 2, 2))) - 0.5
"""Corners of a box with sides of 1 around the origin, shape (8, 3)."""

SIDES = np.array(
    [
        (4, 6, 7), (4, 7, 5), (0, 1, 3), (0, 3, 2),
        (6, 2, 3), (6, 3, 7), (0, 4, 5), (0, 5, 1),
        (1, 5, 7), (1, 7, 3), (0, 2, 6), (0, 6, 4),
    ],
    dtype=np.uint32,
)  # fmt: skip
"""Two triangles for each side of it, rows of `CORNERS`, counterclockwise seen from outside: x, y and z in turn."""


class VoxelBody:
    """The boxes of one layer; they are made anew each time, for a batch keeps its number.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
        Of the node.
    """

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas, self._path = canvas, canvas.path(name)
        self._node: viser.BatchedMeshHandle | None = None

    def clear(self) -> None:
        """Remove the boxes."""
        if self._node is not None:
            self._node.remove()
            self._node = None

    def draw(self, centres: NDArray[np.floating], step: float, colours: NDArray[np.uint8]) -> None:
        """Draw boxes instead of those before.

        Parameters
        ----------
        centres : ndarray, shape (k, 3)
            m, in the world; k > 0.
        step : float
            Side of a voxel, m.
        colours : ndarray of uint8, shape (k, 3)
        """
        self.clear()
        self._node = self._canvas.scene.add_batched_meshes_simple(
            self._path,
            (FILLED * step * CORNERS).astype(np.float32),
            SIDES,
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (len(centres), 1)).astype(np.float32),
            batched_positions=centres.astype(np.float32),
            batched_colors=_instance_colours(colours),
            lod="off",
            flat_shading=True,
            cast_shadow=False,
            receive_shadow=False,
        )


def outside(filled: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the filled voxels with an empty neighbour; the others are hidden."""
    wide = np.pad(filled, 1)
    inner = wide.copy()
    for axis in range(3):
        inner &= np.roll(wide, 1, axis) & np.roll(wide, -1, axis)
    return np.asarray(filled & ~inner[1:-1, 1:-1, 1:-1])


def _instance_colours(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return colours (k, 3) of instances as the page expects them, as linear light."""
    return np.asarray(np.round(255.0 * linear(colours)), dtype=np.uint8)
