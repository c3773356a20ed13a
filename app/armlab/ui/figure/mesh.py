"""Solids as three arrays. Normals are known when a solid is made and need not be computed from triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Solid:
    """A surface of triangles; a sharp edge has its vertices twice, once for each side.

    Attributes
    ----------
    vertices : ndarray, shape (k, 3)
        In metres.
    normals : ndarray, shape (k, 3)
        Of unit length, outwards.
    faces : ndarray, shape (m, 3)
        Rows of ``vertices``, counterclockwise seen from outside.
    """

    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int64]

    @cached_property
    def bounds(self) -> NDArray[np.float64]:
        """The lowest and the highest corner, shape (2, 3)."""
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)])


def shifted(solid: Solid, by: ArrayLike) -> Solid:
    """Return the solid moved by a vector."""
    return Solid(solid.vertices + np.asarray(by, dtype=float), solid.normals, solid.faces)


def placed(solid: Solid, pose: NDArray[np.floating]) -> Solid:
    """Return the solid moved by a rigid 4 x 4 pose."""
    R = pose[:3, :3].T
    return Solid(solid.vertices @ R + pose[:3, 3], solid.normals @ R, solid.faces)


def cut(solid: Solid, first: int, last: int) -> Solid:
    """Return the solid without some of its first and last faces, and without the vertices only they have."""
    kept = solid.faces[first : len(solid.faces) - last]
    used, places = np.unique(kept, return_inverse=True)
    return Solid(solid.vertices[used], solid.normals[used], places.reshape(kept.shape))


def joined(solids: Sequence[Solid]) -> Solid:
    """Return several solids as one."""
    first = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    faces = [solid.faces + start for solid, start in zip(solids, first, strict=False)]
    vertices, normals = [solid.vertices for solid in solids], [solid.normals for solid in solids]
    return Solid(np.concatenate(vertices), np.concatenate(normals), np.concatenate(faces))
