"""Points that the joints of any arm were found to reach: a table in the coordinates of joint 1.

A cell counts as a whole where one sample lies in it, so the edge is thicker than it is by up to a cell.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import FirstJoint, first_joint

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

CHUNKS, CHUNK, SEED = 48, 32_768, 0
"""Chunks, their size and the seed of the configurations of the joints after the first."""

CELLS, TURNS = 96, 180
"""Cells of the table along the longer side of the section, and bins of the turn of joint 1."""

SLAB = 8
"""Rows of cells that are carried on by joint 1 in one piece of work."""


@dataclass(frozen=True, eq=False)
class SampledPoints:
    """Reachable points found by sampling some joints.

    Attributes
    ----------
    joint : FirstJoint
    low, step : ndarray (2,), float
        Corner and side of the cells over (u, v), metres.
    met : ndarray of bool, shape (U, V, S)
        Whether the point with this (u, v) and this s, rad or m, is reached by some turn of joint 1 inside its limits.
    low_s, step_s : float
        Start and width of the bins of s.
    centre, radius
        A ball around all of it.
    """

    joint: FirstJoint
    low: Floats
    step: float
    met: Bools
    low_s: float
    step_s: float
    centre: Floats
    radius: float
    exact: bool = False

    def holds(self, points: ArrayLike) -> Bools:
        """Return a mask of the points (..., 3) in the world, metres, that lie in a cell that was met."""
        coordinates = self.joint.split(points)
        cell = np.floor((coordinates[..., :2] - self.low) / self.step).astype(np.intp)
        turn = np.floor((coordinates[..., 2] - self.low_s) / self.step_s).astype(np.intp)
        shape = np.array(self.met.shape)
        if self.joint.revolute:
            turn = np.mod(turn, shape[2])
        index = np.concatenate([cell, turn[..., None]], axis=-1)
        inside = np.all((index >= 0) & (index < shape), axis=-1)
        index = np.where(inside[..., None], index, 0)
        return np.asarray(inside & self.met[index[..., 0], index[..., 1], index[..., 2]])


def sampling(arm: Arm) -> Iterator[SampledPoints | None]:
    """Yield None after each piece of work of some 30 ms, and at last the points an arm's tool was found to reach."""
    joint, samples = first_joint(arm), []
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for some in _section_samples(arm, joint):
        samples.append(some)
        low, high = np.minimum(low, some.min(axis=0)), np.maximum(high, some.max(axis=0))
        yield None
    yield from _tables(joint, samples, low, high)


def _tables(joint: FirstJoint, samples: list[Floats], low: Floats, high: Floats) -> Iterator[SampledPoints | None]:
    step = float((high - low)[:2].max()) / CELLS or 1.0
    shape = np.floor((high - low)[:2] / step).astype(np.intp) + 1
    if joint.revolute:
        low_s, step_s, bins = -math.pi, math.tau / TURNS, TURNS
        least, most = _turned(joint, step_s, bins)
    else:
        low_s, step_s = float(low[2]) + min(joint.low, 0.0), step
        bins = int((float(high[2]) + max(joint.high, 0.0) - low_s) / step) + 1
        least, most = math.floor(joint.low / step), math.ceil(joint.high / step)
    met = np.zeros((*shape, bins), dtype=bool)
    for some in samples:
        cell = np.minimum(((some[:, :2] - low[:2]) / step).astype(np.intp), shape - 1)
        turn = np.mod(((some[:, 2] - low_s) / step_s).astype(np.intp), bins)
        met[cell[:, 0], cell[:, 1], turn] = True
        yield None
    for k in range(0, int(shape[0]), SLAB):
        met[k : k + SLAB] = _carried(met[k : k + SLAB], least, most, joint.revolute)
        yield None
    ends = joint.join(np.array([[0.0, low[1], low_s], [0.0, high[1], low_s + step_s * bins]]))
    middle = joint.join([0.0, 0.5 * (low[1] + high[1]), 0.0]) if joint.revolute else 0.5 * (ends[0] + ends[1])
    radius = _radius(joint, low, high, step, step_s * bins)
    yield SampledPoints(joint, low[:2], step, met, low_s, step_s, np.asarray(middle), radius)


def _radius(joint: FirstJoint, low: Floats, high: Floats, step: float, along: float) -> float:
    across = max(abs(low[0]), abs(high[0]))
    return math.hypot(across, 0.5 * (high[1] - low[1]), 0.0 if joint.revolute else 0.5 * along) + step


def _turned(joint: FirstJoint, step: float, bins: int) -> tuple[int, int]:
    """Return the least and largest number of bins by which joint 1 may carry a point; the edge is made thicker."""
    if joint.full:
        return 0, bins - 1
    return math.floor(joint.low / step), math.ceil(joint.high / step)


def _carried(met: Bools, least: int, most: int, around: bool) -> Bools:
    """Return the bins of the last axis that lie ``least`` to ``most`` bins behind one that was met."""
    bins, here = met.shape[2], np.arange(met.shape[2])
    if around:
        most, least = least % bins + min(most - least, bins - 1), least % bins
        met, here = np.concatenate([met, met, met], axis=2), here + 2 * bins
    sums = np.zeros((*met.shape[:2], met.shape[2] + 1), dtype=np.int32)
    np.cumsum(met, axis=2, out=sums[:, :, 1:])
    first, last = (np.clip(at, 0, met.shape[2]) for at in (here - most, here - least + 1))
    return np.asarray(sums[:, :, last] > sums[:, :, first])


def _section_samples(arm: Arm, joint: FirstJoint) -> Iterator[Floats]:
    """Yield (u, v, s) of random configurations with q_1 = 0, shape (CHUNK, 3)."""
    rng = np.random.default_rng(SEED)
    low, span = arm.limits[:, 0].copy(), arm.limits[:, 1] - arm.limits[:, 0]
    low[0] = span[0] = 0.0
    for _ in range(CHUNKS):
        q = (low + span * rng.random((CHUNK, arm.n))).astype(np.float32)
        yield joint.split(arm.position(q))
