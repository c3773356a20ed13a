"""Surfaces on which the tool point is shown, and the samples on them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.workspace.approach import MOST, Approaches, Directions, directions, keeps_upright
from armlab.kin.workspace.first_joint import FirstJoint, first_joint

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

CHUNK = 8_192
"""Configurations in one piece of work."""

EXTENT, MARGIN = 32_768, 0.03
"""Number of configurations that determine the size of a picture, and the margin on either side."""

FLAT = 1e-5
"""Width, relative to the wider side, below which a picture is one cell wide."""

ALONG = 1e-6
"""Lack of one, of the cosine between axes that are parallel in single precision."""


class Met(NamedTuple):
    """Configurations with the tool point on a surface.

    Attributes
    ----------
    q : ndarray of float32, shape (k, n)
        Inside the limits.
    places : ndarray, shape (k, 2)
        The two coordinates of the surface, metres.
    axes : ndarray, shape (k, 3)
        The counted direction of the tool: its z axis or, when this is fixed, its x axis about it.
    """

    q: Singles
    places: Floats
    axes: Floats


@dataclass(frozen=True, eq=False)
class Sheet(ABC):
    """A plane or half plane of an arm.

    Attributes
    ----------
    arm : Arm
    s : float
        Coordinate of the surface; see the subclasses.
    """

    arm: Arm
    s: float

    @property
    def joint(self) -> FirstJoint:
        """The coordinates of joint 1."""
        return first_joint(self.arm)

    @cached_property
    def bins(self) -> Directions:
        """The bins in which orientations are counted."""
        return directions(MOST, keeps_upright(self.arm))

    def counted_axes(self, T: Floats, axes: Floats) -> Floats:
        """Return the axes in which directions are counted, as columns (3, 3).

        Parameters
        ----------
        T : ndarray, shape (k, 4, 4)
            Poses of the tool.
        axes : ndarray, shape (3, 3)
            Those of the surface. They serve, unless the tool turns only about a line that is not the third of them.
        """
        z = T[0, :3, 2]
        if not self.bins.circle or abs(z @ axes[:, 2]) > 1.0 - ALONG:
            return axes
        near = axes[:, int(np.argmin(np.abs(z @ axes)))]
        x = near - z * (z @ near)
        x /= np.linalg.norm(x)
        return np.column_stack([x, np.cross(z, x), z])

    def samples(self, count: int, seed: int = 0) -> Iterator[Met]:
        """Yield positions and directions of ``count`` random configurations inside the limits, in chunks.

        Configurations that cannot be brought onto the surface are left out.
        """
        count, seed = whole_number(count, "count", 1), whole_number(seed, "seed", 0)
        rng = np.random.default_rng(seed)
        low, high = within(self.arm)
        for start in range(0, count, CHUNK):
            q = low + (high - low) * rng.random((min(CHUNK, count - start), self.arm.n), dtype=np.float32)
            yield self.met(np.clip(q, low, high))

    @abstractmethod
    def met(self, q: Singles) -> Met:
        """Return positions and directions of the tool at configurations (k, n), an array that may be overwritten."""

    @abstractmethod
    def places(self, points: ArrayLike) -> Floats:
        """Return the coordinates (..., 2) of points (..., 3) in the world, metres."""

    @abstractmethod
    def points(self, places: ArrayLike) -> Floats:
        """Return the points (..., 3) in the world of coordinates (..., 2), metres."""

    @abstractmethod
    def lowest(self, low: Floats) -> Floats:
        """Return the corner of a picture that begins at ``low`` (2,)."""

    def grid(self, cells: int) -> Approaches:
        """Return an empty grid over everything reachable, ``cells`` along its longer side."""
        low, high = within(self.arm)
        q = low + (high - low) * np.random.default_rng(0).random((EXTENT, self.arm.n), dtype=np.float32)
        places = self.places(self.arm.position(q))
        least, most = places.min(axis=0), places.max(axis=0)
        widest = float((most - least).max()) or 1.0
        step = widest * (1.0 + 2.0 * MARGIN) / cells
        flat = most - least <= FLAT * widest
        margin = np.where(flat, 0.5 * step, MARGIN * widest)
        least, most = self.lowest(least - margin), most + np.where(flat, 0.0, margin)
        shape = np.maximum(np.ceil((most - least) / step - 1e-9).astype(int), 1)
        return Approaches(least, step, (int(shape[0]), int(shape[1])), self.bins)


def within(arm: Arm) -> tuple[Singles, Singles]:
    """Return the limits in single precision, rounded inward, each (n,)."""
    low, high = arm.limits[:, 0].astype(np.float32), arm.limits[:, 1].astype(np.float32)
    low = np.where(low < arm.limits[:, 0], np.nextafter(low, np.float32(np.inf)), low)
    high = np.where(high > arm.limits[:, 1], np.nextafter(high, np.float32(-np.inf)), high)
    return low, np.maximum(low, high)
