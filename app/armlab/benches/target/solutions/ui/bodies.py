"""An arm drawn as translucent bodies, one mesh each, without base, rings or shadows."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.ui import adapter
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.figure import Figure
from armlab.ui.figure.mesh import Solid, joined
from armlab.ui.scene._nodes import seen

Floats = NDArray[np.float64]

OPACITY = 0.26

OUTWARDS, FURTHER = 0.05, 0.03
"""Distance by which a ghost is inflated, in radii of joint 1, and the addition for each further one, so that no
surfaces coincide."""

SAME = 0.004
"""Distance, rad or sizes of the arm, below which a body coincides with that of the arm and is left out."""


class Bodies:
    """The bodies of one arm.

    Parameters
    ----------
    canvas : LayerCanvas
    path : str
        Of its nodes.
    number : int
        Which ghost of several it is, from 0.
    on_click : callable
    """

    def __init__(self, canvas: LayerCanvas, path: str, number: int, on_click: Callable[[], None]) -> None:
        self._canvas, self._path, self._number, self._on_click = canvas, path, number, on_click
        self._anatomy = canvas.drawn.figure.anatomy
        self._nodes: list[viser.FrameHandle] = []
        self._meshes: list[Any] = []
        self._q: Floats | None = None
        self._colour: Rgb | None = None

    def show(self, q: Floats, colour: Rgb, arm_q: NDArray[np.floating]) -> None:
        """Show the arm in a configuration (n,), except bodies that coincide with those of the arm itself."""
        if not self._nodes:
            self._make(colour)
        for i, body in enumerate(self._anatomy.bodies):
            if self._q is not None and self._q[i] == q[i]:
                continue
            if body.revolute:
                adapter.set_wxyz(self._nodes[i], body.node_wxyz(float(q[i])))
            else:
                adapter.set_position(self._nodes[i], body.node_position(float(q[i])))
        self._q = np.array(q)
        for mesh, on in zip(self._meshes, self._apart(q, arm_q), strict=True):
            if mesh is None:
                continue
            seen(mesh, on)
            if colour != self._colour:
                mesh.color = colour
        self._colour = colour

    def hide(self) -> None:
        """Hide all bodies."""
        for mesh in self._meshes:
            if mesh is not None:
                seen(mesh, False)

    def _make(self, colour: Rgb) -> None:
        scene, root, self._colour = self._canvas.scene, self._anatomy.root, colour
        path = self._path
        scene.add_frame(path, show_axes=False, wxyz=quaternion_from_rotation(root[:3, :3]), position=root[:3, 3])
        for i, (body, solid) in enumerate(zip(self._anatomy.bodies, solids_of(self._canvas.drawn.figure), strict=True)):
            path += f"/{i + 1}"
            wxyz, position = body.node_wxyz(0.0), body.node_position(0.0)
            self._nodes.append(scene.add_frame(path, show_axes=False, wxyz=wxyz, position=position))
            self._meshes.append(None if solid is None else self._mesh(f"{path}/ghost", solid, colour))

    def _mesh(self, path: str, solid: Solid, colour: Rgb) -> viser.MeshHandle:
        by = (OUTWARDS + FURTHER * self._number) * float(self._anatomy.radius[0])
        mesh = self._canvas.scene.add_mesh_simple(
            path,
            (solid.vertices + by * solid.normals).astype(np.float32),
            solid.faces.astype(np.uint32),
            color=colour,
            opacity=OPACITY,
            cast_shadow=False,
            receive_shadow=False,
        )
        adapter.on_event(mesh, "on_click", lambda _: self._on_click())
        return mesh

    def _apart(self, q: Floats, arm_q: NDArray[np.floating]) -> list[bool]:
        """Return for each body whether its place differs from that of the arm's body.

        One without an a may also be turned about its axis, along which it runs.
        """
        arm, bodies = self._anatomy.arm, self._anatomy.bodies
        mine, its = np.asarray(arm.frames(np.array([q, arm_q])), dtype=np.float64)
        apart = np.abs(mine - its)
        apart[:, :3, 3] /= self._canvas.size
        same = apart.max(axis=(1, 2)) < SAME
        on_axis = apart[:, :3, 2:].max(axis=(1, 2)) < SAME
        axes = on_axis[:-1] if arm.convention == "standard" else on_axis[1:]
        last = len(bodies) - 1
        return [
            not (same[i + 1] or (axes[i] and body.revolute and body.a == 0.0 and i < last))
            for i, body in enumerate(bodies)
        ]


@lru_cache(maxsize=16)
def solids_of(figure: Figure) -> tuple[Solid | None, ...]:
    """Return one solid for each moving body of a figure (figures are compared by identity)."""
    return tuple(joined([solid for _, solid in parts]) if parts else None for parts in figure.parts[1:])
