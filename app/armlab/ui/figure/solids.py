"""Solids that the arms are made of, with bevelled edges so that light can catch them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

SIDES = 28
FILLET_POINTS = 9
DOME_RINGS = 5


def lathe(profile: Sequence[tuple[float, float]], sides: int = SIDES) -> trimesh.Trimesh:
    """Return a solid of revolution about z from (radius, height) points, bottom to top, closed on the axis."""
    return trimesh.creation.revolve(np.array(profile, dtype=float), sections=sides)


def drum(radius: float, half_length: float, bevel: float, z: float = 0.0) -> trimesh.Trimesh:
    """Return a cylinder about z with rounded edges, its middle at height z."""
    r, h, b = radius, half_length, bevel
    rim = [(r - b, -h), (r - 0.3 * b, -h + 0.3 * b), (r, -h + b), (r, h - b), (r - 0.3 * b, h - 0.3 * b), (r - b, h)]
    return lathe([(0.0, z - h), *((x, z + y) for x, y in rim), (0.0, z + h)])


def block(size: ArrayLike, bevel: float, at: ArrayLike = (0.0, 0.0, 0.0)) -> trimesh.Trimesh:
    """Return a box with bevelled edges around a point."""
    half = np.asarray(size, dtype=float) / 2.0
    corners = np.array(list(np.ndindex(2, 2, 2))) * 2.0 - 1.0
    points = []
    for k in range(3):
        extent = half - bevel
        extent[k] = half[k]
        points.append(corners * extent)
    mesh = trimesh.convex.convex_hull(np.vstack(points))
    mesh.apply_translation(np.asarray(at, dtype=float))
    return mesh


def tube(points: Sequence[ArrayLike], start: float, end: float, bend: float) -> trimesh.Trimesh:
    """Return a round tube through points with filleted corners and domed ends.

    Parameters
    ----------
    points : sequence of array_like, shape (3,)
    start, end : float
        Radii at the ends; linear along the path in between.
    bend : float
        Radius of the fillets, as far as the legs allow.
    """
    path = _filleted([np.asarray(p, dtype=float) for p in points], bend)
    directions = np.gradient(path, axis=0)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    radii = start + (end - start) * lengths / lengths[-1]
    rings = _rings(path, directions, radii)
    return trimesh.Trimesh(np.vstack(rings), _skin(len(rings)), process=False)


def _filleted(corners: list[NDArray[np.float64]], bend: float) -> NDArray[np.float64]:
    path = [corners[0]]
    for before, corner, after in zip(corners, corners[1:], corners[2:], strict=False):
        into, out = corner - before, after - corner
        into_length, out_length = float(np.linalg.norm(into)), float(np.linalg.norm(out))
        into, out = into / into_length, out / out_length
        angle = float(np.arccos(np.clip(into @ out, -1.0, 1.0)))
        cut = min(bend * np.tan(angle / 2.0), 0.48 * into_length, 0.48 * out_length)
        a, b = corner - cut * into, corner + cut * out
        path += [(1 - t) ** 2 * a + 2 * t * (1 - t) * corner + t * t * b for t in np.linspace(0, 1, FILLET_POINTS)]
    path.append(corners[-1])
    return np.array(path)


def _rings(
    path: NDArray[np.float64], directions: NDArray[np.float64], radii: NDArray[np.float64]
) -> list[NDArray[np.float64]]:
    """Return circles along the path, with shrinking ones at both ends that close the tube with a dome."""
    phi = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    normal = np.cross(directions[0], [1.0, 0.0, 0.0] if abs(directions[0][0]) < 0.8 else [0.0, 1.0, 0.0])
    bulge = np.linspace(0.0, np.pi / 2.0, DOME_RINGS)
    rings = []
    last = len(path) - 1
    for k, (centre, direction, radius) in enumerate(zip(path, directions, radii, strict=True)):
        # Carry the normal along without twist, so that the quads of neighbouring rings face each other.
        normal = normal - direction * (normal @ direction)
        normal /= np.linalg.norm(normal)
        other = np.cross(direction, normal)
        circle = np.cos(phi)[:, None] * normal + np.sin(phi)[:, None] * other
        side = -1.0 if k == 0 else 1.0
        steps = bulge[::-1] if k == 0 else bulge if k == last else [0.0]
        for b in steps:
            shift = side * radius * np.sin(b) * direction
            rings.append(centre + shift + max(radius * float(np.cos(b)), 1e-6) * circle)
    return rings


def _skin(count: int) -> NDArray[np.int64]:
    i = np.arange(SIDES)
    j = (i + 1) % SIDES
    faces = []
    for k in range(count - 1):
        a, b = k * SIDES, (k + 1) * SIDES
        faces += [np.column_stack([a + i, a + j, b + j]), np.column_stack([a + i, b + j, b + i])]
    return np.vstack(faces)


def along(direction: ArrayLike, at: ArrayLike = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """Return a 4 x 4 pose at a point with its z axis along a direction."""
    z = np.asarray(direction, dtype=float)
    z = z / np.linalg.norm(z)
    x = np.array([1.0, 0.0, 0.0] if abs(z[0]) < 0.9 else [0.0, 1.0, 0.0])
    x -= z * (x @ z)
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, np.cross(z, x), z, np.asarray(at, dtype=float)
    return pose


def placed(mesh: trimesh.Trimesh, pose: NDArray[np.floating]) -> trimesh.Trimesh:
    """Return the mesh moved by a 4 x 4 pose."""
    moved = mesh.copy()
    moved.apply_transform(pose)
    return moved
