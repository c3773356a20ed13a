"""Changes of nodes that layers share; nothing is sent when nothing changes."""

from __future__ import annotations

from typing import Any

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.ui import adapter
from armlab.ui.colours import Rgb
from armlab.ui.figure.marks import FRAME_LENGTH, frame_glb
from armlab.ui.figure.mesh import Solid


def write(label: viser.LabelHandle, text: str) -> None:
    """Change the text of a label if it differs."""
    if label.text != text:
        label.text = text


def seen(handle: Any, on: bool) -> None:
    """Show or hide a node."""
    if handle.visible != on:
        handle.visible = on


def move(handle: Any, position: ArrayLike) -> None:
    """Move a node."""
    x, y, z = np.asarray(position, dtype=float).tolist()
    adapter.set_position(handle, (x, y, z))


def turn(handle: Any, rotation: NDArray[np.floating]) -> None:
    """Turn a node to a rotation matrix."""
    w, x, y, z = quaternion_from_rotation(rotation).tolist()
    adapter.set_wxyz(handle, (w, x, y, z))


def put(handle: Any, pose: NDArray[np.floating]) -> None:
    """Turn and move a node to a pose, shape (4, 4)."""
    turn(handle, pose[:3, :3])
    move(handle, pose[:3, 3])


def add_solid(scene: viser.SceneApi, path: str, solid: Solid, colour: Rgb, **options: Any) -> viser.MeshHandle:
    """Add a solid of one colour without shadows."""
    return scene.add_mesh_simple(
        path,
        solid.vertices.astype(np.float32),
        solid.faces.astype(np.uint32),
        color=colour,
        cast_shadow=False,
        receive_shadow=False,
        **options,
    )


def add_triad(scene: viser.SceneApi, path: str, size: float, **options: Any) -> viser.GlbHandle:
    """Add the three arrows of a frame, for an arm of this size."""
    scale = FRAME_LENGTH * size
    return scene.add_glb(path, frame_glb(), scale=scale, cast_shadow=False, receive_shadow=False, **options)
