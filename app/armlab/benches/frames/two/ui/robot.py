"""A planar robot with links of one length, drawn like the lab's arms; its figure is made once and scaled."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.frames.two.reach import planar
from armlab.ui import adapter
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.figure import Figure, build_figure
from armlab.ui.scene._nodes import put, seen

Floats = NDArray[np.float64]


@lru_cache(maxsize=4)
def _figure(links: int) -> tuple[Figure, tuple[bytes | None, ...]]:
    """Return the figure of a robot with links of 1 m, and the GLB files of its bodies."""
    figure = build_figure(planar(links, 1.0))
    return figure, tuple(figure.glbs())


class Robot:
    """A robot, made when it is first shown.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
        Of its node.
    links : int
    """

    def __init__(self, canvas: LayerCanvas, name: str, links: int) -> None:
        self._canvas, self._path, self._links = canvas, canvas.path(name), links
        self._root: viser.FrameHandle | None = None
        self._nodes: list[viser.FrameHandle] = []
        self._meshes: list[viser.GlbHandle] = []

    def show(self, base: Floats, q: Floats, link: float) -> None:
        """Show the robot on a base (4, 4) at joint values (n,), radians, with links of a length, metres."""
        if self._root is None:
            self._root = self._made()
        seen(self._root, True)
        put(self._root, base)
        figure, _ = _figure(self._links)
        for mesh in self._meshes:
            if mesh.scale != link:
                mesh.scale = link
        for node, body, value in zip(self._nodes, figure.anatomy.bodies, q.tolist(), strict=True):
            x, y, z = body.node_position(value)
            adapter.set_position(node, (link * x, link * y, link * z))
            adapter.set_wxyz(node, body.node_wxyz(value))

    def hide(self) -> None:
        """Hide the robot."""
        if self._root is not None:
            seen(self._root, False)

    def _made(self) -> viser.FrameHandle:
        scene, path = self._canvas.scene, self._path
        root = scene.add_frame(path, show_axes=False)
        _, glbs = _figure(self._links)
        for k, glb in enumerate(glbs):
            if k > 0:
                path += f"/{k}"
                self._nodes.append(scene.add_frame(path, show_axes=False))
            if glb is not None:
                self._meshes.append(scene.add_glb(f"{path}/body", glb, cast_shadow=True, receive_shadow=True))
        return root
