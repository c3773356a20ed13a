"""From which directions a spherical wrist brings the tool to a point, for all points at once.

With a wrist that turns freely the wrist centre can be anywhere on the sphere of radius L about the tool point, L the
distance between the two. So the directions possible at p are the part of this sphere that lies in the workspace W of
the wrist centre: W convolved with a spherical shell of mass 1. One FFT gives it on a grid of the whole space.

What the wrist joints cannot do for their limits is not counted: the fraction is an upper bound then.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.screws import screws_of
from armlab.kin.lines import PARALLEL_ANGLE
from armlab.kin.workspace.approach import spread
from armlab.kin.workspace.first_joint import FULL_TURN
from armlab.kin.workspace.wrist_points import WristPoints, finding_wrist_points
from armlab.kin.wrist import wrist_centre

Floats = NDArray[np.float64]

RESOLUTIONS = (48, 96)
"""Voxels along an edge: a first picture, and the whole one."""

ALL = 0.995
"""Fraction of the directions above which a voxel counts as dexterous: voxels smear the edge of W."""

SHELL = 20_000
"""Points that stand for the shell."""

BLOCK = 24_576
"""Voxels that are tested in one piece of work."""

NO_TOOL = 1e-9
"""Metres below which the tool point is the wrist centre."""


@dataclass(frozen=True, eq=False)
class Coverage:
    """The fraction of approach directions on a grid of cubes.

    Attributes
    ----------
    low : ndarray, shape (3,)
        Corner of the grid in the world, metres.
    step : float
        Edge of a voxel, metres.
    fraction : ndarray of float32, shape (N, N, N)
        0 to 1 at the centres of the voxels.
    tool : float
        L, metres.
    points : WristPoints
        Where the wrist centre can be.
    free_wrist : bool
        Whether the wrist's own limits leave it every orientation; else the fraction is an upper bound.
    finished : bool
        Whether the grid is as fine as was asked for.
    """

    low: Floats
    step: float
    fraction: NDArray[np.float32]
    tool: float
    points: WristPoints
    free_wrist: bool
    finished: bool = True

    @cached_property
    def dexterous(self) -> NDArray[np.bool_]:
        """The voxels of WS2, shape (N, N, N): more than `ALL` of the directions."""
        return np.asarray(self.fraction > ALL)

    @cached_property
    def volume(self) -> float:
        """Volume of WS2, m³, voxels counted whole."""
        return float(self.dexterous.sum()) * self.step**3

    @cached_property
    def volume_error(self) -> float:
        """What the volume of WS2 may be wrong by, m³: as much as its outermost voxels hold.

        They count whole and the shell is smeared over neighbours, so the boundary may be a voxel off.
        """
        wide = np.pad(self.dexterous, 1)
        inner = wide.copy()
        for axis in range(3):
            inner &= np.roll(wide, 1, axis) & np.roll(wide, -1, axis)
        return float((wide & ~inner).sum()) * self.step**3

    @cached_property
    def reached(self) -> float:
        """Volume of WS1, m³: each voxel with any direction at all, so it errs to the large side."""
        return float((self.fraction > 1.0 - ALL).sum()) * self.step**3

    def at(self, points: ArrayLike) -> Floats:
        """Return the fraction at points (..., 3) in the world, metres, linear between the voxels."""
        place = (np.asarray(points, dtype=np.float64) - self.low) / self.step - 0.5
        count = self.fraction.shape[0]
        cell = np.floor(place).astype(np.intp)
        inside = np.all((cell >= 0) & (cell < count - 1), axis=-1)
        cell = np.clip(cell, 0, count - 2)
        part = place - cell
        total = np.zeros(place.shape[:-1])
        for corner in np.ndindex(2, 2, 2):
            weight = np.prod(np.where(corner, part, 1.0 - part), axis=-1)
            total += weight * self.fraction[tuple(cell[..., k] + corner[k] for k in range(3))]
        return np.where(inside, total, 0.0)


def coverage(arm: Arm, resolution: int = RESOLUTIONS[-1]) -> Coverage:
    """Return the fraction of approach directions of an arm with a spherical wrist, everywhere.

    The limits of the joints in front of the wrist are respected, those of the wrist are not (`Coverage.free_wrist`).

    Parameters
    ----------
    arm : Arm
    resolution : int
        Voxels along an edge, 8 to 256.

    Raises
    ------
    InputError
        No spherical wrist with joints in front of it, or a resolution out of range.

    References
    ----------
    WS2 of the notes, 4.21.
    """
    *_, found = coverages(arm, (resolution,))
    assert found is not None
    return found


def coverages(arm: Arm, resolutions: tuple[int, ...] = RESOLUTIONS) -> Iterator[Coverage | None]:
    """Yield a coverage for each resolution, in pieces of some 30 ms of work: None where there is nothing to show yet.

    Raises
    ------
    InputError
        As `coverage`.
    """
    if not all(8 <= resolution <= 256 for resolution in resolutions):
        raise InputError(f"resolution: expected 8 to 256 voxels along an edge, got {list(resolutions)}")
    centre = wrist_centre(arm)
    if centre is None:
        raise InputError("arm: expected joints in front of a spherical wrist")
    tool, free = float(np.linalg.norm(centre)), turns_freely(arm)
    points: WristPoints | None = None
    for found in finding_wrist_points(arm):
        points = found
        yield None
    assert points is not None
    for resolution in resolutions:
        half = points.radius + tool
        step = 2.0 * half / (resolution - 2)
        low = points.centre - 0.5 * resolution * step
        inside = np.zeros(resolution**3, dtype=np.float32)
        for start in range(0, resolution**3, BLOCK):
            index = np.arange(start, min(start + BLOCK, resolution**3))
            cells = np.stack(np.unravel_index(index, (resolution,) * 3), axis=-1)
            inside[index] = points.holds(low + (cells + 0.5) * step)
            yield None
        fraction = inside.reshape((resolution,) * 3)
        if tool > NO_TOOL:
            for piece in _convolved(fraction, tool / step):
                fraction = piece
                yield None
        yield Coverage(low, step, fraction, tool, points, free, resolution == resolutions[-1])


def coverage_at(points: WristPoints, tool: float, where: ArrayLike, count: int = 4096) -> float:
    """Return the fraction of directions at one point (3,) in the world, metres, from ``count`` of them."""
    about = np.asarray(where, dtype=np.float64) - tool * spread(count)
    return float(points.holds(about).mean())


def turns_freely(arm: Arm) -> bool:
    """Return whether the limits of the last three joints let a spherical wrist take every orientation.

    Its outer joints turn all the way round, and the middle one makes every angle between their axes.
    """
    first, second, third = screws_of(arm).z[-3:]
    spans = arm.limits[-3:, 1] - arm.limits[-3:, 0]
    if min(spans[0], spans[2]) < math.tau - FULL_TURN:
        return False
    low, high = arm.limits[-2]
    along = (first @ second) * (second @ third)
    across = third - second * (second @ third)
    x, y = float(first @ across), float(first @ np.cross(second, across))
    # The cosine of the angle between the outer axes is along + x cos q + y sin q: extreme at the limits, or where its
    # derivative is zero.
    turn = math.atan2(y, x)
    steps = np.arange(math.ceil((low - turn) / math.pi), math.floor((high - turn) / math.pi) + 1)
    q = np.array([low, high, *(turn + math.pi * steps)])
    cosine = along + x * np.cos(q) + y * np.sin(q)
    return bool(cosine.min() <= PARALLEL_ANGLE - 1.0 and cosine.max() >= 1.0 - PARALLEL_ANGLE)


def _convolved(inside: NDArray[np.float32], radius: float) -> Iterator[NDArray[np.float32]]:
    """Yield pieces of the convolution with a shell whose radius is given in voxels; the last is the result."""
    shell = _shell(inside.shape[0], radius)
    yield inside
    spectrum = np.fft.rfftn(inside)
    yield inside
    spectrum *= np.fft.rfftn(shell)
    yield inside
    result = np.fft.irfftn(spectrum, s=inside.shape, axes=(0, 1, 2))
    yield np.clip(result, 0.0, 1.0).astype(np.float32)


def _shell(count: int, radius: float) -> NDArray[np.float32]:
    """Return a spherical shell of mass 1 about voxel 0 of a grid that goes on at its ends, shape (count,) * 3."""
    place = radius * spread(SHELL)
    cell = np.floor(place).astype(np.intp)
    part = place - cell
    indices, weights = [], []
    for corner in np.ndindex(2, 2, 2):
        weights.append(np.prod(np.where(corner, part, 1.0 - part), axis=-1) / SHELL)
        around = tuple(np.mod(cell[:, k] + corner[k], count) for k in range(3))
        indices.append(np.ravel_multi_index(around, (count,) * 3))
    total = np.bincount(np.concatenate(indices), np.concatenate(weights), count**3)
    return np.asarray(total.reshape((count,) * 3), dtype=np.float32)
