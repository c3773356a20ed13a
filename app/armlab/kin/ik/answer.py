"""What every way of finding all solutions hands on: verified configurations and what is known about them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import Completeness, sorted_rows, wrapped_rows
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import EXACT, distinct, polished
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

SURFACE = 16
"""Configurations that stand for a family of more than one dimension."""

BEYOND = "The target is farther away than all links in a line."


@dataclass(frozen=True, eq=False)
class Answer:
    """Verified configurations of an arm and what is known about them, before names and limits."""

    q: list[Vector]
    completeness: Completeness
    reason: str
    method: str
    why: str
    families: tuple[Vector, ...] = ()


def verified_rows(
    arm: Arm, T: Vector, candidates: Sequence[Vector], held: Mapping[int, float] | None = None
) -> list[Vector]:
    """Return polished candidates that forward kinematics confirms, wrapped, without repetition, in canonical order."""
    target = task_error_of(arm).target(T)
    mask = held_mask(arm, held) if held else None
    good = [q for one in candidates if (q := polished(arm, one, target, mask)) is not None]
    return in_order(arm, distinct(arm, good), mask)


def in_order(arm: Arm, solutions: Sequence[Vector] | Vector, held: NDArray[np.bool_] | None = None) -> list[Vector]:
    """Return solutions inside the limits by whole turns, where that can be, in canonical order; held joints as are."""
    q = np.array(solutions).reshape(-1, arm.n)
    rows = wrapped_rows(arm, q) if held is None else np.where(held, q, wrapped_rows(arm, q))
    return list(rows[sorted_rows(rows)])


def held_mask(arm: Arm, held: Mapping[int, float]) -> NDArray[np.bool_]:
    """Return which joints are held, (n,), from 0-based joints and their values."""
    return np.array([i in held for i in range(arm.n)])


def is_beyond(arm: Arm, T: Vector) -> bool:
    """Return whether the controlled coordinates alone are out of reach; slides are not held to their limits."""
    if not bool(arm.revolute.all()) or not arm.task.position:
        return False
    G = inverse(arm.base) @ T
    return math.hypot(*(float(G[k, 3]) for k in arm.task.coordinates)) > arm.reach * (1.0 + EXACT) + EXACT
