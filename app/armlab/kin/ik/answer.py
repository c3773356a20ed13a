"""The common result of the solvers that find all solutions: verified configurations and what is known of them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.nearly_still import is_dependent
from armlab.kin.ik.problem import REACHED_M, Errors
from armlab.kin.ik.solutions import Completeness, sorted_rows, wrapped_rows
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import EXACT, ROUNDING, each_once, is_reached, polished
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

SURFACE = 16
"""Number of configurations that represent a family of more than one dimension."""

NEAR = 1e-2
"""Scaled error below which a candidate that is no solution casts doubt on the others."""

SINGULAR = 1e-4
"""Singular value of a Jacobian, relative to the largest, below which a closed form is checked by other means."""

BEYOND = "The target is farther away than all links in a line."


@dataclass(frozen=True, eq=False)
class Answer:
    """Verified configurations of an arm and what is known about them, before names and limits.

    ``loose`` and ``missed`` are those of `Verified`.
    """

    q: list[Vector]
    completeness: Completeness
    reason: str
    method: str
    why: str
    families: tuple[Vector, ...] = ()
    loose: int = 0
    missed: tuple[float, float] | None = None


class Verified(NamedTuple):
    """Candidates after verification.

    Attributes
    ----------
    rows : list of ndarray, shape (n,)
        Solutions, wrapped, each once, in canonical order.
    loose : int
        Number of solutions that are not exact, but as near as possible and within what counts as reached.
    missed : tuple of float, or None
        Errors in m and rad of the worst of those; without solutions, of the nearest candidate.
    dropped : bool
        Whether a candidate near the target was none.
    singular : bool
        Whether a solution is so near a singularity that another, or a family, may hide behind it.
    """

    rows: list[Vector]
    loose: int
    missed: tuple[float, float] | None
    dropped: bool
    singular: bool

    @property
    def doubtful(self) -> bool:
        """Whether there may be further solutions, or a family."""
        return self.dropped or self.singular


def verified(arm: Arm, T: Vector, candidates: Sequence[Vector], held: Mapping[int, float] | None = None) -> Verified:
    """Return polished candidates that forward kinematics confirms."""
    target = task_error_of(arm).target(T)
    mask = held_mask(arm, held) if held else None
    every = [polished(arm, one, target, mask) for one in candidates]
    reached = [is_reached(arm, one.errors, target) for one in every]
    good = each_once(arm, [one for one, there in zip(every, reached, strict=True) if there], target)
    loose = [one.errors for one in good if _size(one.errors) > EXACT]
    # Told are the worst of what is let through, or the best of what is not.
    best = [one.errors for one in every] if not good else []
    told = max(loose, key=_size) if loose else min(best, key=_size, default=None)
    missed = None if told is None else (told.position, told.rotation)
    dropped = any(_size(one.errors) < NEAR and not there for one, there in zip(every, reached, strict=True))
    singular = any(_is_nearly_singular(one.J) for one in good)
    return Verified(in_order(arm, [one.q for one in good], mask), len(loose), missed, dropped, singular)


def verified_rows(arm: Arm, T: Vector, candidates: Sequence[Vector]) -> list[Vector]:
    """Return only the solutions of `verified`, (n,) each."""
    return verified(arm, T, candidates).rows


def _is_nearly_singular(J: Vector) -> bool:
    """Return whether a Jacobian (m, n) is within `SINGULAR` of losing rank, or nearly loses two."""
    if len(J) == 6 == J.shape[1]:
        # The other five singular values multiply to no more than (sum of squares / 5)^(5/2); this costs a tenth. Two
        # that are dependent make a determinant still smaller.
        most = float((J * J).sum() / 5.0) ** 2.5
        if abs(float(np.linalg.det(J))) > SINGULAR * most * math.sqrt(float((J * J).sum())):
            return False
    values = np.linalg.svd(J, compute_uv=False)
    return bool(values[-1] < SINGULAR * values[0]) or bool(is_dependent(np.asarray(values, dtype=np.float64)))


def _size(errors: Errors) -> float:
    return math.sqrt(errors.scaled2)


def in_order(arm: Arm, solutions: Sequence[Vector] | Vector, held: NDArray[np.bool_] | None = None) -> list[Vector]:
    """Return solutions (n,) in canonical order, by whole turns inside the limits if possible; held joints stay."""
    q = np.array(solutions).reshape(-1, arm.n)
    rows = wrapped_rows(arm, q) if held is None else np.where(held, q, wrapped_rows(arm, q))
    return list(rows[sorted_rows(rows)])


def held_mask(arm: Arm, held: Mapping[int, float]) -> NDArray[np.bool_]:
    """Return a mask (n,) of the held joints, from values by 0-based joint."""
    return np.array([i in held for i in range(arm.n)])


def is_beyond(arm: Arm, T: Vector) -> bool:
    """Return whether the controlled coordinates alone are out of reach; sliding joints count without limits."""
    if not bool(arm.revolute.all()) or not arm.task.position:
        return False
    G = inverse(arm.base) @ T
    return math.hypot(*(float(G[k, 3]) for k in arm.task.coordinates)) > arm.reach * (1.0 + ROUNDING) + REACHED_M
