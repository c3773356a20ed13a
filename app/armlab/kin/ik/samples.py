"""Starts for descents: of many random configurations those whose tool is nearest to the target.

The nearer the start, the fewer the steps and the seldomer the descent runs out of the limits: from the nearest of a
thousand it takes six steps where a random start takes ten, and to find the nearest costs less than one of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import many_at_once
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.task import Task

Floats = NDArray[np.float64]

COUNT = 1024
"""Number of configurations in a table: with more the search in it takes longer than it saves."""

TABLES = 8
"""Largest number of tables of an arm; seeds use them in turn."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Random configurations inside the limits of an arm, the less singular half of many, with their tool poses.

    Attributes
    ----------
    q : ndarray, shape (k, n)
    places : ndarray, shape (k, 13)
        Times the 12 numbers of a target and 1: the squared distance of its tool from there, up to a constant.
    """

    q: Floats
    places: Floats

    def nearest(self, target: Sequence[float]) -> Floats:
        """Return the configuration (n,) with the tool nearest to a target, given by its 12 numbers in frame 0."""
        return np.asarray(self.q[int(self._distances(target).argmin())])

    def near(self, target: Sequence[float], count: int) -> Floats:
        """Return the nearest configurations (count, n), the nearest first."""
        far = self._distances(target)
        first = np.argpartition(far, count)[:count] if count < len(far) else np.arange(len(far))
        return np.asarray(self.q[first[np.argsort(far[first], kind="stable")]])

    def _distances(self, target: Sequence[float]) -> Floats:
        return np.asarray(self.places @ np.array([*target, 1.0]))


def samples_of(arm: Arm, seed: int) -> Samples:
    """Return a table of an arm (arms are compared by identity), always the same for the same seed."""
    return _samples_of(arm, seed % TABLES)


@lru_cache(maxsize=64)
def _samples_of(arm: Arm, seed: int) -> Samples:
    low, width = task_error_of(arm).starts
    drawn = low + width * np.random.default_rng(seed).random((2 * COUNT, arm.n))
    q = drawn[np.argsort(-_manipulability(arm, drawn), kind="stable")[:COUNT]]
    tools, weights = many_at_once(arm).tools(q)[:, :3].reshape(COUNT, 12), _weights(arm.task, arm.length_scale)
    # |a - b|² = a² - 2 a b + b², of which the last is the same for all.
    return Samples(q, np.column_stack([-2.0 * weights * tools, tools**2 @ weights]))


def _manipulability(arm: Arm, q: Floats) -> Floats:
    """Return the squared manipulability (k,): descents from nearly singular samples often fail."""
    J, _ = many_at_once(arm).linearised(q, np.eye(4))
    turned = np.swapaxes(J, 1, 2)
    return np.asarray(np.linalg.det(J @ turned if arm.task.m <= arm.n else turned @ J))


def _weights(task: Task, length_scale: float) -> Floats:
    """Return the factors (12) of the squared differences of two poses (3 x 4, by rows) in the squared scaled error.

    For one column of a rotation their sum is (2 sin(theta/2))² for a turn across it, and of all three twice as much.
    """
    turned: dict[str, list[int]] = {
        "none": [],
        "phi": [0, 4],
        "approach": [2, 6, 10],
        "full": [0, 1, 2, 4, 5, 6, 8, 9, 10],
    }
    weights = np.zeros(12)
    weights[[4 * k + 3 for k in task.coordinates]] = length_scale**-2
    weights[turned[task.rotation]] = 0.5 if task.rotation == "full" else 1.0
    return weights
