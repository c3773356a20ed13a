"""Where a descent had best begin: of many random configurations those whose tool is nearest to the target.

The nearer the start, the fewer the steps and the seldomer the descent runs out of the limits: from the nearest of a
thousand it takes four steps where a random start takes ten, and to find the nearest costs less than one of them.
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
"""Configurations of one table: with more it takes longer to look than is saved on the way."""

TABLES = 8
"""Different tables of an arm at most; seeds share them in turn."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Random configurations inside the limits of an arm, and where they put the tool.

    Attributes
    ----------
    q : ndarray, shape (k, n)
    places : ndarray, shape (k, f + 1)
        For each minus twice the features of its tool (see `_features`) and the sum of their squares: times the features
        of a target and 1 it is the squared distance up to a constant.
    entries : list of int
        Which of the 12 numbers of a target are its features.
    """

    q: Floats
    places: Floats
    entries: list[int]
    scales: list[float]

    def nearest(self, target: Sequence[float]) -> Floats:
        """Return the configuration (n,) whose tool is nearest to a target, its 12 numbers in frame 0."""
        return np.asarray(self.q[int(self._distances(target).argmin())])

    def near(self, target: Sequence[float], count: int) -> Floats:
        """Return the nearest configurations (count, n) in order."""
        far = self._distances(target)
        first = np.argpartition(far, count)[:count] if count < len(far) else np.arange(len(far))
        return np.asarray(self.q[first[np.argsort(far[first], kind="stable")]])

    def _distances(self, target: Sequence[float]) -> Floats:
        goal = [target[entry] * scale for entry, scale in zip(self.entries, self.scales, strict=True)]
        return np.asarray(self.places @ np.array([*goal, 1.0]))


def samples_of(arm: Arm, seed: int) -> Samples:
    """Return a table of an arm (arms are compared by identity), the same for the same seed."""
    return _samples_of(arm, seed % TABLES)


@lru_cache(maxsize=64)
def _samples_of(arm: Arm, seed: int) -> Samples:
    low, width = task_error_of(arm).starts
    q = low + width * np.random.default_rng(seed).random((COUNT, arm.n))
    entries, scales = _features(arm.task, arm.length_scale)
    tools = many_at_once(arm).tools(q)[:, :3].reshape(COUNT, 12)
    features = tools[:, entries] * scales
    return Samples(q, np.column_stack([-2.0 * features, np.sum(features**2, axis=1)]), entries, scales)


def _features(task: Task, length_scale: float) -> tuple[list[int], list[float]]:
    """Return the entries of a pose (3 x 4, by rows) that the task controls, and the factors that make them comparable.

    The sum of the squares of their differences is then the squared scaled error: of columns of a rotation it is
    (2 sin(theta/2))² for one column and twice as much for three.
    """
    places = [4 * k + 3 for k in task.coordinates]
    turns = {
        "none": [],
        "phi": [0, 4],
        "approach": [2, 6, 10],
        "full": [0, 1, 2, 4, 5, 6, 8, 9, 10],
    }[task.rotation]
    factor = 0.5**0.5 if task.rotation == "full" else 1.0
    return places + turns, [1.0 / length_scale] * len(places) + [factor] * len(turns)
