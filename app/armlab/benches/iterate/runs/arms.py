"""The configurations that solve a task vector with joints in it, such as the two of (p_x, p_y, q3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import TaskVector, iterate

STARTS = 12
MOST = 30
"""Number of random starts of the search, and of steps from each: some 50 ms."""

SAME = 1e-3
"""Chord of angles, or length in length scales, up to which two solutions are one."""


class Asked(NamedTuple):
    """Arm, target pose as bytes, task vector, and the values of the held joints (None for a free one)."""

    arm: Arm
    target: bytes
    task: TaskVector
    held: tuple[float | None, ...]


@dataclass(frozen=True, eq=False)
class Arms:
    """Solutions ``q`` (k, n), rad or m, which are not proven to be all."""

    asked: Asked
    q: NDArray[np.float64]


def arms_of(asked: Asked) -> Arms:
    """Return the solutions found from seeded random starts, or none if they would be infinitely many."""
    arm, found = asked.arm, np.zeros((0, asked.arm.n))
    locked = tuple(value is not None for value in asked.held)
    if arm.n - sum(locked) != asked.task.m:
        return Arms(asked, found)
    rng, target = np.random.default_rng(0), np.frombuffer(asked.target).reshape(4, 4).copy()
    low, high = arm.limits.T
    for start in rng.uniform(low, high, (STARTS, arm.n)):
        q0 = np.array([own if own is not None else value for own, value in zip(asked.held, start, strict=True)])
        trace = iterate(arm, target, q0, "dls_error", most=MOST, limits="none", locked=locked, task=asked.task)
        if trace.success and not _known(arm, found, trace.q[-1]):
            found = np.vstack([found, trace.q[-1]])
    return Arms(asked, found)


def _known(arm: Arm, found: NDArray[np.float64], q: NDArray[np.float64]) -> bool:
    apart = np.where(arm.revolute, np.abs(2.0 * np.sin(0.5 * (found - q))), np.abs(found - q) / arm.length_scale)
    return bool(np.any(np.all(apart < SAME, axis=-1)))
