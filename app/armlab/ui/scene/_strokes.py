"""Thin lines, arrow heads and names, of which overlays are made."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.ui.colours import Rgb
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import add_solid

Floats = NDArray[np.float64]
Segments = NDArray[np.float32]

THIN, THICK = 0.0032, 0.006
"""Thickness of lines, in sizes of the arm."""

HEAD = 0.027
"""Length of an arrow head, in sizes of the arm."""

NAME_SCALE = 0.85
"""Size of the letters, relative to viser's own."""


def polyline(points: ArrayLike) -> Segments:
    """Return the segments (k, 2, 3) of a line through points (k+1, 3)."""
    at = np.asarray(points, dtype=np.float32)
    return np.stack([at[:-1], at[1:]], axis=1)


def dashes(start: ArrayLike, end: ArrayLike, count: int) -> Segments:
    """Return dashes of a line, (count, 2, 3), one of them at each end."""
    first, last = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    parts = np.linspace(0.0, 1.0, 2 * count)[:, None]
    ends: Segments = (first + parts * (last - first)).reshape(count, 2, 3).astype(np.float32)
    return ends


def add_line(
    scene: viser.SceneApi, path: str, segments: Segments, colour: Rgb, size: float, thickness: float = THIN
) -> viser.LineSegmentsHandle:
    """Add lines (k, 2, 3) of one colour; the thickness is given in sizes of the arm."""
    return scene.add_line_segments(path, segments, colour, thickness=thickness * size)


def add_head(
    scene: viser.SceneApi, path: str, tip: ArrayLike, direction: ArrayLike, colour: Rgb, length: float
) -> viser.MeshHandle:
    """Add an arrow head with its tip at a point; the length is in metres."""
    unit = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    wxyz = quaternion_from_rotation(along(unit)[:3, :3])
    position = np.asarray(tip, dtype=float) - length * unit
    return add_solid(scene, path, _cone(), colour, scale=length, wxyz=wxyz, position=position)


@cache
def _cone() -> Solid:
    """Return a head of unit length along z, from the origin."""
    return lathe([(0.0, 0.0), (0.36, 0.0), (0.0, 1.0)], sides=20)


def add_name(scene: viser.SceneApi, path: str, text: str, at: ArrayLike, anchor: Any) -> viser.LabelHandle:
    """Add a name in the size of all overlays."""
    position = np.asarray(at, dtype=float)
    return scene.add_label(path, text, position=position, font_screen_scale=NAME_SCALE, anchor=anchor)


def stretch(line: viser.LineSegmentsHandle, factors: ArrayLike) -> None:
    """Stretch a line of unit length, which may have to point the other way.

    Parameters
    ----------
    line : viser.LineSegmentsHandle
    factors : array_like, shape (3,)
        Zero along the axes in which the line does not extend.
    """
    scale = [float(factor) for factor in np.asarray(factors, dtype=float)]
    side = 1.0 if sum(factor < 0.0 for factor in scale) % 2 == 0 else -1.0
    free = scale.index(0.0)
    # The page draws nothing that is mirrored, so an axis without extent is mirrored as well.
    scale[free] = side
    x, y, z = (factor or 1.0 for factor in scale)
    line.scale = (x, y, z)
