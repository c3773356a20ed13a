"""Square cells over the section of a workspace, large enough for everything that can be reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import STILL, FirstJoint
from armlab.kin.workspace.pull import pull

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

FIRST_LOOK = 4096
"""Number of samples that show roughly where the tool comes."""

EXTREMES = 12
"""Number of these, on each side, that are pulled outwards as far as they go."""

PULLS = 24
"""Iterations of a pull to an extreme."""

MARGIN = 2
"""Number of empty cells on each side."""

COARSER = {True: 2, False: 3}
"""Cells along the side of a coarse cell, in which s is counted, by whether (u, v) leave single values of s: intervals
need more samples."""

ASIDE = 1.0 / 128.0
"""Distance from the edge of a cell, in cells, at which a line from the axis begins: halving would otherwise meet the
edge itself, and always find it too far out."""

PLANAR_FINER = 8
"""Factor of the resolution of a planar arm, which has a single row of cells."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Cells of a section.

    Attributes
    ----------
    joint : FirstJoint
    step : float
        Side of a cell, metres.
    low : (float, float)
        Metres: where the first cell of u, and of v, begins.
    shape : (int, int)
        Cells along u and along v; one along v for a planar arm.
    extremes : ndarray, shape (2, 2)
        Least and largest u, then v, that were reached.
    at_axis : bool
        Whether the first cells begin on the axis of a joint 1 that turns: nothing is beyond.
    flat : bool
        Whether v is the same everywhere.
    coarser : int
        Cells along a side of one in which s is counted.
    """

    joint: FirstJoint
    step: float
    low: tuple[float, float]
    shape: tuple[int, int]
    extremes: Floats
    at_axis: bool
    flat: bool
    coarser: int

    @property
    def u(self) -> Floats:
        """Centres along u, (Nu,), metres."""
        return np.asarray(self.low[0] + self.step * (np.arange(self.shape[0]) + 0.5))

    @property
    def v(self) -> Floats:
        """Centres along v, (Nv,), metres."""
        if self.flat:
            return np.array([self.low[1]])
        return np.asarray(self.low[1] + self.step * (np.arange(self.shape[1]) + 0.5))

    @property
    def single(self) -> bool:
        """Whether (u, v) leave single values of s, as for an arm without spare joints, rather than intervals."""
        return len(self.joint.moving) <= (1 if self.flat else 2)

    def cell_of(self, uv: Floats) -> tuple[Indices, NDArray[np.bool_]]:
        """Return the flat indices of the cells of points (..., 2), and which points are on the grid."""
        i = np.floor((uv[..., 0] - self.low[0]) / self.step).astype(np.intp)
        j = np.zeros_like(i) if self.flat else np.floor((uv[..., 1] - self.low[1]) / self.step).astype(np.intp)
        inside = (i >= 0) & (i < self.shape[0]) & (j >= 0) & (j < self.shape[1])
        return np.where(inside, i * self.shape[1] + j, 0), inside

    def centres(self, cells: Indices) -> Floats:
        """Return (u, v) of the centres of cells, shape (k, 2)."""
        return np.stack([self.u[cells // self.shape[1]], self.v[cells % self.shape[1]]], axis=1)


def random_configurations(joint: FirstJoint, count: int, rng: np.random.Generator) -> Floats:
    """Return configurations (count, n) with q_1 = 0, moving joints anywhere in their limits and the others near 0."""
    limits = joint.arm.limits
    moving = list(joint.moving)
    q = np.tile(np.clip(0.0, limits[:, 0], limits[:, 1]), (count, 1))
    low, high = limits[moving].T
    q[:, moving] = np.minimum(low + (high - low) * rng.random((count, len(moving))), high)
    q[:, 0] = 0.0
    return q


def grid_for(joint: FirstJoint, resolution: int, rng: np.random.Generator) -> tuple[Grid, Floats]:
    """Return cells for all that can be reached, and the configurations that looked for it.

    Parameters
    ----------
    joint : FirstJoint
    resolution : int
        Cells along the longer side; of a planar arm `PLANAR_FINER` times as many.
    rng : Generator
    """
    q = random_configurations(joint, FIRST_LOOK, rng)
    uv = joint.split(joint.arm.position(q))[:, :2]
    q = np.concatenate([q, _pulled_out(joint, q, uv)])
    uv = joint.split(joint.arm.position(q))[:, :2]
    extremes = np.stack([uv.min(axis=0), uv.max(axis=0)], axis=1)
    size = np.ptp(extremes, axis=1)
    whole = STILL * (joint.arm.reach or 1.0)
    flat = joint.planar and bool(size[1] <= whole * FIRST_LOOK)
    step = float(max(size.max(), whole) / (resolution * (PLANAR_FINER if flat else 1) - ASIDE))
    first = np.floor(extremes[:, 0] / step).astype(int) - MARGIN
    at_axis = joint.revolute and first[0] <= 0
    if at_axis:
        first[0] = 0
    cells = np.floor(extremes[:, 1] / step).astype(int) + 1 + MARGIN - first
    low_v = float(extremes[1].mean()) if flat else float(first[1] * step)
    coarser = COARSER[len(joint.moving) <= (1 if flat else 2)]
    shape = (int(cells[0]), 1 if flat else int(cells[1]))
    return Grid(joint, step, (float(first[0] * step), low_v), shape, extremes, bool(at_axis), flat, coarser), q


def _pulled_out(joint: FirstJoint, q: Floats, uv: Floats) -> Floats:
    """Return the places to which the outermost samples on each side come when they are pulled farther out."""
    far = 2.0 * (joint.arm.reach or 1.0)
    starts, targets, weights = [], [], []
    for side in (0, 1):
        for sign in (-1.0, 1.0):
            chosen = np.argsort(-sign * uv[:, side])[:EXTREMES]
            target = uv[chosen].copy()
            target[:, side] = 0.0 if joint.revolute and side == 0 and sign < 0.0 else sign * far
            starts.append(q[chosen])
            targets.append(target)
            weights.append(np.tile(np.eye(2)[side], (len(chosen), 1)))
    pulled = pull(
        joint,
        np.concatenate(starts),
        np.concatenate(targets),
        0.0,
        iterations=PULLS,
        weights=np.concatenate(weights),
    )
    return pulled[0]
