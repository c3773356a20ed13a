"""The base frame before which the body turns."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import AXES
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.glb import scene_glb
from armlab.ui.figure.mesh import placed
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import move, seen

LENGTH, WIDTH, HEAD = 1.4, 0.007, 0.09
"""Length and radius of its arrows, and length of their heads, in radii of the outermost ring."""


class BaseFrame:
    """Three thin, long arrows that do not turn, with their names."""

    def __init__(self, canvas: LayerCanvas, name: str, radius: float) -> None:
        scene, path = canvas.scene, canvas.path(name)
        self._node = scene.add_frame(path, show_axes=False)
        scene.add_glb(f"{path}/arrows", base_glb(), scale=radius, cast_shadow=False, receive_shadow=False)
        for k, axis in enumerate(AXES):
            at = (LENGTH + 0.07) * radius * np.eye(3)[k]
            scene.add_label(f"{path}/{axis}", axis, position=at, font_screen_scale=0.9, anchor="center-center")

    def show(self, centre: NDArray[np.float64]) -> None:
        """Move its origin to a point (3,)."""
        move(self._node, centre)

    def visible(self, on: bool) -> None:
        """Show or hide it."""
        seen(self._node, on)


@cache
def base_glb() -> bytes:
    """Return the arrows for a ring of radius 1."""
    arrow = lathe(
        [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, LENGTH - HEAD), (3.6 * WIDTH, LENGTH - HEAD), (0.0, LENGTH)], sides=16
    )
    units = zip(np.eye(3), AXES.values(), strict=True)
    return scene_glb([(placed(arrow, along(unit)), (colour, 0.6, 0.0)) for unit, colour in units])
