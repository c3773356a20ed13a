"""The plane of a planar arm, seen from above, with unchanged random configurations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.workspace.sheet import Met, Sheet, Singles

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class WholePlane(Sheet):
    """The plane of an arm whose tool point stays in one; s is its height along the normal, metres.

    Its coordinates are two of the axes of the arm's `FirstJoint` from its origin.
    """

    @property
    def across(self) -> Floats:
        """The axes of the coordinates, and the normal: columns (3, 3), right-handed."""
        axes = self.joint.axes
        return axes if self.joint.revolute else np.column_stack([axes[:, 2], axes[:, 0], axes[:, 1]])

    def met(self, q: Singles) -> Met:
        """Return positions and directions of the tool in the plane, at configurations."""
        T = np.asarray(self.arm.fk(q), dtype=np.float64)
        axes = self.counted_axes(T, self.across)
        return Met(q, self.places(T[:, :3, 3]), T[:, :3, 0 if self.bins.circle else 2] @ axes)

    def places(self, points: ArrayLike) -> Floats:
        """Return the coordinates (..., 2) of points (..., 3) in the world, metres."""
        return np.asarray((np.asarray(points, dtype=np.float64) - self.joint.origin) @ self.across[:, :2])

    def points(self, places: ArrayLike) -> Floats:
        """Return the points (..., 3) of the plane, in the world, with coordinates (..., 2), metres."""
        given = np.asarray(places, dtype=np.float64)
        return np.asarray(self.joint.origin + given @ self.across[:, :2].T + self.s * self.across[:, 2])

    def lowest(self, low: Floats) -> Floats:
        """Return the corner of a picture: where the picture begins."""
        return low
