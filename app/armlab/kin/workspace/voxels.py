"""Numbers of points, and the mean of a value, in the voxels of a grid: a cloud of any size in constant memory."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.rotations import rotation_about

Floats = NDArray[np.float64]
Array = NDArray[np.floating]

FEWEST, MOST = 2, 256
"""Least and largest number of voxels along a side."""

MARGIN = 0.25
"""Distance, in voxels, between what can be reached and the sides of the grid, more than any rounding."""

PARALLEL = 1e-9
"""Sine of the angle below which axes count as parallel."""


@dataclass(eq=False)
class Voxels:
    """A grid of cubes that counts points and adds up their values.

    Parameters
    ----------
    low : ndarray, shape (3,)
        Corner in the world, metres.
    step : float
        Edge of a voxel, metres.
    shape : (int, int, int)
        Voxels along x, y, z.

    Attributes
    ----------
    count : ndarray, shape `shape`, int64
        Points in each.
    total : ndarray, shape `shape`
        Sum of their values.
    """

    low: Floats
    step: float
    shape: tuple[int, int, int]
    count: NDArray[np.int64] = field(init=False)
    total: Floats = field(init=False)

    def __post_init__(self) -> None:
        self.count = np.zeros(self.shape, np.int64)
        self.total = np.zeros(self.shape)

    def add(self, points: Array, values: Array) -> None:
        """Count points (k, 3) in metres, and add their values (k,).

        Raises
        ------
        InputError
            A point outside the grid; nothing is counted then.
        """
        cells = self.cells(points)
        # On equal types these are NumPy's fast ways, whatever the number of voxels.
        np.add.at(self.count.reshape(-1), cells, 1)
        np.add.at(self.total.reshape(-1), cells, np.asarray(values, dtype=np.float64))

    def cells(self, points: Array) -> NDArray[np.intp]:
        """Return the flat index (k,) of the voxel in which each point (k, 3) lies.

        Raises
        ------
        InputError
            A point outside the grid, or one that is not a number.
        """
        points = np.asarray(points)
        scaled = np.empty((3, len(points)), points.dtype)
        np.subtract(points.T, self.low.astype(points.dtype)[:, None], out=scaled)
        scaled *= 1.0 / self.step
        if len(points):
            smallest, largest = scaled.min(axis=1), scaled.max(axis=1)
            if not (np.all(smallest >= 0.0) and np.all(largest < self.shape)):
                high = self.low + self.step * np.array(self.shape)
                raise InputError(f"points: expected all between {self.low} m and {high} m, some lie outside")
        x, y, z = scaled.astype(np.intp)
        x *= self.shape[1]
        x += y
        x *= self.shape[2]
        x += z
        return np.asarray(x)

    @property
    def filled(self) -> NDArray[np.bool_]:
        """Mask of the voxels with at least one point, of shape `shape`."""
        return np.asarray(self.count > 0)

    def mean(self) -> Floats:
        """Return the mean value of each voxel, of shape `shape`; nan where there is no point."""
        mean = np.full(self.shape, np.nan)
        np.divide(self.total, self.count, out=mean, where=self.count > 0)
        return mean

    def centres(self, chosen: ArrayLike | None = None) -> Floats:
        """Return the centres (k, 3) in metres of chosen voxels (a mask of shape `shape`), else of the filled ones.

        In the order of ``mask.nonzero()``, so that ``mean()[mask]`` are their values.
        """
        mask = self.filled if chosen is None else np.asarray(chosen, dtype=bool)
        return np.asarray(self.low + self.step * (np.argwhere(mask) + 0.5))

    def copy(self) -> Voxels:
        """Return a copy that does not change when points are added here."""
        other = Voxels(self.low, self.step, self.shape)
        other.count[...], other.total[...] = self.count, self.total
        return other


def voxels_for(arm: Arm, resolution: int = 64) -> Voxels:
    """Return an empty cube of voxels that holds all the arm can reach.

    The middle of what `reach_box` gives is the centre of a voxel, so that the points of a planar arm lie in one layer.

    Parameters
    ----------
    arm : Arm
    resolution : int
        Voxels along each side.

    Raises
    ------
    InputError
        A resolution out of range.
    """
    if not FEWEST <= resolution <= MOST:
        raise InputError(f"resolution: expected {FEWEST} to {MOST}, got {resolution}")
    low, high = reach_box(arm)
    side = float((high - low).max()) or 1.0
    step = side / (resolution - 1 - 2 * MARGIN)
    middle = (resolution - 1) // 2 + 0.5
    return Voxels((low + high) / 2 - middle * step, step, (resolution,) * 3)


def reach_box(arm: Arm) -> tuple[Floats, Floats]:
    """Return two corners (3,), in the world and metres, of a box outside of which the tool point cannot be.

    Links between two turning joints are rigid, or slide; what comes before the first of these joints has known
    directions, what follows it turns about its axis as long as the axes are parallel, and any way after that. The
    limits of sliding joints count, those of turning joints do not: the box may be larger than the workspace.
    """
    walk = _Walk(arm.base)
    for row, limits in zip(arm.rows, arm.limits, strict=True):
        if arm.convention == "modified":
            walk.link(row)
        walk.joint(row, limits)
        if arm.convention == "standard":
            walk.link(row)
    walk.along(arm.tool[:3, 3])
    walk.close()
    around = np.zeros(3) if walk.axis is None else np.sqrt(np.maximum(0.0, 1.0 - walk.axis**2))
    half = walk.disc * around + walk.ball
    return walk.low - half, walk.high + half


class _Walk:
    """The sum, from base to tool, of how far the parts of an arm reach."""

    def __init__(self, base: Floats) -> None:
        self.R = np.array(base[:3, :3])
        self.low, self.high = np.array(base[:3, 3]), np.array(base[:3, 3])
        self.axis: Floats | None = None
        self.disc = self.ball = 0.0
        self.free = False
        self.part = np.zeros((1, 3))
        """Points whose hull contains the end of the part since the last revolute joint."""

    def along(self, shift: Floats) -> None:
        self.part = self.part + self.R @ shift

    def link(self, row: Row) -> None:
        self.along(np.array([row.a, 0.0, 0.0]))
        self.R = self.R @ rotation_about("x", row.alpha)

    def joint(self, row: Row, limits: Floats) -> None:
        if row.revolute:
            self.close()
            z = self.R[:, 2]
            if self.axis is None:
                self.axis = z
            elif np.linalg.norm(np.cross(self.axis, z)) > PARALLEL:
                self.free = True
            self.along(np.array([0.0, 0.0, row.d]))
        else:
            ends = [self.part + self.R[:, 2] * (row.d + limit) for limit in limits]
            self.part = np.concatenate(ends)
        self.R = self.R @ rotation_about("z", row.theta)

    def close(self) -> None:
        """Add the part that ends here to the reach."""
        if self.axis is None:
            self.low, self.high = self.low + self.part.min(axis=0), self.high + self.part.max(axis=0)
        elif self.free:
            self.ball += float(np.linalg.norm(self.part, axis=1).max())
        else:
            lifts = (self.part @ self.axis)[:, None] * self.axis
            self.low, self.high = self.low + lifts.min(axis=0), self.high + lifts.max(axis=0)
            self.disc += float(np.linalg.norm(self.part - lifts, axis=1).max())
        self.part = np.zeros((1, 3))
