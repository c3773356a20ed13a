"""The directions from which a spherical wrist brings the tool to a point, for all points at once.

The wrist centre is at the distance L from the tool point p. A direction d, from the wrist centre to the tool point, is
possible at p where an arm with the wrist centre at p - L d exists, inside the limits, whose forearm stands so that the
wrist can turn the tool into d.

Joint 1 turns all of it. So places in the half plane behind joint 1 are enough, with directions on rings about its axis:
for each node, ring and angle of the direction there is a word of which each bit is an angle of the node about the axis,
and says whether the direction is possible there. Words of the nodes a tool's length behind each other are turned into
place and their bits counted.

Where joint 1 slides, the wrist's own limits are left out: then the part of the sphere about p that lies in the
workspace W of the wrist centre is counted, W convolved with a spherical shell by FFT, and each share is an upper bound.
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
from armlab.kin.workspace.approach import spread
from armlab.kin.workspace.elbow_points import ElbowPoints
from armlab.kin.workspace.first_joint import FirstJoint, first_joint
from armlab.kin.workspace.forearms import Forearms, elbow_forearms, rank, sampled_forearms, turned, whole_turn
from armlab.kin.workspace.half_grid import HalfGrid
from armlab.kin.workspace.wrist_points import WristPoints, finding_wrist_points, front_of
from armlab.kin.workspace.wrist_turns import NO_TOOL, WristTurns, turns_freely, within, wrist_turns
from armlab.kin.wrist import wrist_centre

Floats = NDArray[np.float64]

RESOLUTIONS = (48, 96)
"""Voxels along an edge: for a first picture, and for the final one."""

ALL = 0.995
"""Fraction of the directions above which a voxel counts as dexterous: voxels blur the edge of W."""

SHELL = 20_000
"""Number of points that represent the shell."""

BLOCK = 24_576
"""Voxels that are tested in one piece of work."""

RINGS, AROUND, TURNS = 16, 32, 64
"""Rings of directions about axis 1, of equal areas; directions on each ring; angles about axis 1, one bit each."""

FOREARMS = 1024
"""Forearms whose directions are looked up in one piece of work."""


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
        The points that the wrist centre reaches.
    turns : WristTurns
        The rotations that the wrist reaches.
    proper : bool
        Whether the limits of the wrist are counted, or leave it every orientation; else the fraction is an upper bound.
    finished : bool
        Whether the grid is as fine as was asked for.
    """

    low: Floats
    step: float
    fraction: NDArray[np.float32]
    tool: float
    points: WristPoints
    turns: WristTurns
    proper: bool
    finished: bool = True

    @cached_property
    def dexterous(self) -> NDArray[np.bool_]:
        """The voxels of WS2, shape (N, N, N): more than `ALL` of the directions."""
        return np.asarray(self.fraction > ALL)

    @cached_property
    def volume(self) -> float:
        """Volume of WS2, m³, counted in whole voxels."""
        return float(self.dexterous.sum()) * self.step**3

    @cached_property
    def volume_error(self) -> float:
        """The error of the volume of WS2, m³: the volume of its outermost voxels.

        They count whole and the shell is smeared over neighbours, so the boundary may be a voxel off.
        """
        wide = np.pad(self.dexterous, 1)
        inner = wide.copy()
        for axis in range(3):
            inner &= np.roll(wide, 1, axis) & np.roll(wide, -1, axis)
        return float((wide & ~inner).sum()) * self.step**3

    @cached_property
    def reached(self) -> float:
        """Volume of WS1, m³: all voxels with any direction, which is rather too large."""
        return float((self.fraction > 1.0 - ALL).sum()) * self.step**3

    def at(self, points: ArrayLike) -> Floats:
        """Return the fraction at points (..., 3) in the world, metres, by linear interpolation between voxels."""
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

    The limits of all joints are respected, but those of the wrist where joint 1 slides (`Coverage.proper`).

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
    if wrist_centre(arm) is None:
        raise InputError("arm: expected joints in front of a spherical wrist")
    turns, front = wrist_turns(arm), front_of(arm)
    revolves = bool(front.revolute[0])
    points: WristPoints | None = None
    for found in finding_wrist_points(arm):
        points = found
        yield None
    assert points is not None
    for resolution in resolutions:
        step = 2.0 * (points.radius + turns.length) / (resolution - 2)
        low = points.centre - 0.5 * resolution * step
        pieces = _by_joint_1(front, points, turns, low, step, resolution) if revolves else None
        fraction = np.zeros((resolution,) * 3, dtype=np.float32)
        for piece in pieces or _by_shell(points, turns.length, low, step, resolution):
            fraction = fraction if piece is None else piece
            yield None
        proper = revolves or turns_freely(arm)
        yield Coverage(low, step, fraction, turns.length, points, turns, proper, resolution == resolutions[-1])


def coverage_at(found: Coverage, where: ArrayLike, count: int = 4096) -> float:
    """Return the fraction of directions at one point (3,) in the world, metres, from ``count`` of them.

    Where no closed form tells how the forearm stands, what the grid says about there.
    """
    directions = spread(count)
    if not found.proper or found.turns.free:
        return float(found.points.holds(np.asarray(where) - found.tool * directions).mean())
    if isinstance(found.points, ElbowPoints):
        return float(directed(found.points, found.turns, where, directions).mean())
    return float(found.at(where))


def tried_at(found: Coverage, count: int) -> int:
    """Return the number of directions on which `coverage_at` is based when asked for ``count``."""
    by_grid = found.proper and not found.turns.free and not isinstance(found.points, ElbowPoints)
    return RINGS * AROUND if by_grid else count


def directed(elbow: ElbowPoints, turns: WristTurns, where: ArrayLike, directions: Floats) -> NDArray[np.bool_]:
    """Return which directions (k, 3) of the tool an elbow with a wrist reaches at a point (3,), within the limits."""
    possible = np.zeros(len(directions), dtype=bool)
    for rows, q1, bend, inside in elbow.ways(np.asarray(where, dtype=np.float64) - turns.length * directions):
        some = np.flatnonzero(inside & within(elbow.limits[0], q1))
        turn = elbow.forearm(q1[some], bend[some])
        possible[rows[some]] |= turns.allows(np.einsum("kij,ki->kj", turn, directions[rows[some]]))
    return possible


def _by_joint_1(
    front: Arm, points: WristPoints, turns: WristTurns, low: Floats, step: float, resolution: int
) -> Iterator[NDArray[np.float32] | None]:
    """Yield None after each piece of work, and at last the fraction at the voxels."""
    joint = first_joint(front)
    middle = float(joint.split(points.centre)[1])
    grid = HalfGrid(middle - 0.5 * (resolution - 1) * step, step, (resolution // 2 + 1, resolution))
    forearms: Forearms | None = None
    if isinstance(points, ElbowPoints):
        forearms = elbow_forearms(front, points, grid)
    else:
        for found in sampled_forearms(front, grid):
            forearms = found
            yield None
    assert forearms is not None
    for _ in turns.preparing():
        yield None
    words = np.zeros((grid.shape[0] * grid.shape[1], RINGS * AROUND), dtype=np.uint64)
    for _ in _noted(words, forearms, turns, joint.high - joint.low):
        yield None
    counts: NDArray[np.float32] | None = None
    for share in _counted(words.reshape(*grid.shape, RINGS, AROUND), turns.length / step):
        counts = share
        yield None
    assert counts is not None
    yield from _at_voxels(counts, grid, joint, low, step, resolution)


def _ring_directions() -> NDArray[np.float32]:
    """Return directions (3, RINGS * AROUND), ring by ring."""
    height = 1.0 - (2.0 * np.arange(RINGS) + 1.0) / RINGS
    across, angle = np.sqrt(1.0 - height**2), np.arange(AROUND) * (math.tau / AROUND)
    x, y = across[:, None] * np.cos(angle), across[:, None] * np.sin(angle)
    return np.stack([x, y, np.broadcast_to(height[:, None], x.shape)]).reshape(3, -1).astype(np.float32)


def _noted(words: NDArray[np.uint64], forearms: Forearms, turns: WristTurns, stroke: float) -> Iterator[None]:
    """Set the bits of the directions that each forearm makes possible, as seen from the half plane of its node."""
    directions, masks = _ring_directions(), whole_turn(forearms.start, stroke, TURNS)
    order = rank(forearms.node)
    for k in range(int(order.max(initial=-1)) + 1):
        of_rank = np.flatnonzero(order == k)
        for begin in range(0, len(of_rank), FOREARMS):
            some = of_rank[begin : begin + FOREARMS]
            # The direction in the axes of the forearm: turn^T d.
            local = np.einsum("kji,jd->ikd", forearms.turn[some].astype(np.float32), directions, optimize=True)
            words[forearms.node[some]] |= np.where(turns.looked_up(local), masks[some, None], np.uint64(0))
            yield


def _counted(words: NDArray[np.uint64], length: float) -> Iterator[NDArray[np.float32] | None]:
    """Yield None after each piece of work, and at last the share of directions, (U, V, TURNS); tool length in steps."""
    U, V = words.shape[:2]
    u = np.arange(U)[:, None]
    psi = np.arange(AROUND) * (math.tau / AROUND)
    planes = [np.zeros((U, V), dtype=np.uint64) for _ in range((RINGS * AROUND).bit_length())]
    number = 0
    by_ring = np.ascontiguousarray(words.transpose(2, 3, 0, 1))
    yield None
    for ring in range(RINGS):
        height = 1.0 - (2.0 * ring + 1.0) / RINGS
        across = length * math.sqrt(1.0 - height * height)
        x, y = u - across * np.cos(psi), -across * np.sin(psi)
        behind, turn = np.minimum(np.rint(np.hypot(x, y)).astype(int), U - 1), np.arctan2(y, x)
        seen = np.mod(np.rint((psi - turn) * (AROUND / math.tau)).astype(int), AROUND)
        by = np.mod(np.rint(turn * (TURNS / math.tau)).astype(int), TURNS).astype(np.uint64)
        shift = round(length * height)
        to, source = slice(max(shift, 0), V + min(shift, 0)), slice(max(-shift, 0), V - max(shift, 0))
        for k in range(AROUND):
            found = np.zeros((U, V), dtype=np.uint64)
            found[:, to] = by_ring[ring, seen[:, k], behind[:, k], source]
            number += 1
            _add(planes, turned(found, by[:, k, None]), number)
        yield None
    total = np.zeros((U, V, TURNS), dtype=np.float32)
    for power, plane in enumerate(planes):
        bits = np.unpackbits(plane.view(np.uint8).reshape(U, V, 8), axis=-1, bitorder="little")
        total += np.float32(2**power / (RINGS * AROUND)) * bits
    yield total


def _add(planes: list[NDArray[np.uint64]], carry: NDArray[np.uint64], number: int) -> None:
    """Add a bit to each counter; the bits of the counters lie in planes, and none exceeds ``number``."""
    for plane in planes[: number.bit_length()]:
        after = plane & carry
        plane ^= carry
        carry = after


def _at_voxels(
    counts: NDArray[np.float32], grid: HalfGrid, joint: FirstJoint, low: Floats, step: float, resolution: int
) -> Iterator[NDArray[np.float32] | None]:
    """Yield None after each piece of work, and at last the values between the nodes, at the centres of voxels."""
    U, V, turns = counts.shape
    flat = counts.reshape(-1) if not joint.full else counts[:, :, 0].reshape(-1)
    turns = turns if not joint.full else 1
    result = np.zeros(resolution**3, dtype=np.float32)
    for start in range(0, resolution**3, BLOCK):
        index = np.arange(start, min(start + BLOCK, resolution**3))
        cells = np.stack(np.unravel_index(index, (resolution,) * 3), axis=-1)
        u, v, s = np.moveaxis(joint.split(low + (cells + 0.5) * step), -1, 0)
        total = np.zeros(len(index))
        for i, wi in _beside(u / step, U):
            for j, wj in _beside((v - grid.low) / step, V):
                for k, wk in (
                    _beside(np.mod(s, math.tau) * (turns / math.tau), turns, True) if turns > 1 else [(0, 1.0)]
                ):
                    total += wi * wj * wk * flat[(i * V + j) * turns + k]
        result[index] = total
        yield None
    yield result.reshape((resolution,) * 3)


def _beside(at: Floats, count: int, around: bool = False) -> list[tuple[NDArray[np.intp], Floats]]:
    """Return the nodes on both sides of places, with their weights; none beyond the last."""
    below = np.floor(at).astype(np.intp)
    part = at - below
    if around:
        return [(np.mod(below, count), 1.0 - part), (np.mod(below + 1, count), part)]
    return [
        (np.clip(node, 0, count - 1), np.where((node >= 0) & (node < count), weight, 0.0))
        for node, weight in ((below, 1.0 - part), (below + 1, part))
    ]


def _by_shell(
    points: WristPoints, tool: float, low: Floats, step: float, resolution: int
) -> Iterator[NDArray[np.float32] | None]:
    """Yield None after each piece of work, and at last the fraction at the voxels, ignoring the wrist's limits."""
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
    yield fraction


def _convolved(inside: NDArray[np.float32], radius: float) -> Iterator[NDArray[np.float32]]:
    """Yield stages of the convolution with a shell of a radius given in voxels; the last is the result."""
    shell = _shell(inside.shape[0], radius)
    yield inside
    spectrum = np.fft.rfftn(inside)
    yield inside
    spectrum *= np.fft.rfftn(shell)
    yield inside
    result = np.fft.irfftn(spectrum, s=inside.shape, axes=(0, 1, 2))
    yield np.clip(result, 0.0, 1.0).astype(np.float32)


def _shell(count: int, radius: float) -> NDArray[np.float32]:
    """Return a spherical shell of mass 1 about voxel 0 of a periodic grid, shape (count,) * 3."""
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
