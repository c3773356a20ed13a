"""The way to another solution: the nearest one inside the limits, or the reason why there is none."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import closed_form_of, known_structure
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve_all import solve_all

Vector = NDArray[np.float64]

HERE = 1e-3
"""Distance in all joints, radians or length scales, below which an arm is at a solution."""

ON_CURVE = 0.2
"""Distance, radians and length scales, below which a configuration is on a curve of solutions; points on it are at most
`armlab.kin.ik.self_motion.STEP`, 0.15, apart."""

OTHER_STARTS = 12
"""Number of random starts when another branch is sought for an arm whose solutions are slow to find or infinite."""


def gap(arm: Arm, one: NDArray[np.float64], other: NDArray[np.float64]) -> Vector:
    """Return the difference (n,) of joint values up to whole turns, in radians and length scales."""
    apart = one - other
    turned = apart - math.tau * np.round(apart / math.tau)
    return np.where(arm.revolute, turned, apart / arm.length_scale)


def nearest_copy(arm: Arm, solution: Vector, q: Vector) -> Vector | None:
    """Return a solution (n,) moved by whole turns nearest to q inside the limits; None when it is outside."""
    low, high = arm.limits.T
    turns = np.round((q - solution) / math.tau)
    # Rounding must not push a value that is at a limit over it.
    least, most = np.ceil((low - solution) / math.tau - 1e-9), np.floor((high - solution) / math.tau + 1e-9)
    there = np.where(arm.revolute, solution + math.tau * np.clip(turns, least, np.maximum(least, most)), solution)
    return np.asarray(arm.clip(there)) if arm.within_limits(there) else None


def is_quick(arm: Arm) -> bool:
    """Return whether all solutions of an arm are finitely many, and quick enough to find within a command."""
    if known_structure(arm).free:
        return False
    by_elimination = arm.n == 6 and bool(arm.revolute.all()) and arm.task.key == "pose"
    return by_elimination or closed_form_of(arm) is not None


def another_way(arm: Arm, T: NDArray[np.floating], q: Vector, locked: Sequence[bool], method: str) -> Vector:
    """Return the nearest other solution inside the limits, shape (n,).

    Raises
    ------
    InputError
        There is none, or a search found none.
    """
    if any(locked) or not is_quick(arm):
        return _searched(arm, T, q, locked, method)
    found = solve_all(arm, T)
    others = [k for k in range(len(found)) if float(np.abs(gap(arm, found.q[k], q)).max()) > HERE]
    copies = [copy for k in others if (copy := nearest_copy(arm, found.q[k], q)) is not None]
    if copies:
        scales = np.where(arm.revolute, 1.0, arm.length_scale)
        return min(copies, key=lambda copy: float(np.linalg.norm((copy - q) / scales)))
    raise InputError(_why_not(found, others, q))


def _why_not(found: IkSolutions, others: list[int], q: Vector) -> str:
    if not others:
        return f"There is no other solution. {found.sentence}"
    nearest = min(others, key=lambda k: float(np.linalg.norm(gap(found.arm, found.q[k], q))))
    count = "The only other solution is" if len(others) == 1 else f"All {len(others)} other solutions are"
    return f"{count} outside the limits. {found.names[nearest].capitalize()}: {found.how_far_out[nearest]} its limit."


def _searched(arm: Arm, T: NDArray[np.floating], q: Vector, locked: Sequence[bool], method: str) -> Vector:
    reached = ik.judge(arm, T, q, locked).reached
    if reached and known_structure(arm).free and not any(locked):
        raise InputError("The arm has reached the target, which has infinitely many solutions: see the page Solutions.")
    rng = np.random.default_rng(0)
    for _ in range(OTHER_STARTS):
        start = np.where(locked, q, rng.uniform(arm.limits[:, 0], arm.limits[:, 1]))
        found = ik.solve(arm, T, start, method, locked=locked, searches=1, complete=False)
        if found.success and float(np.abs(gap(arm, found.q, q)).max()) > HERE:
            return np.asarray(found.q, dtype=np.float64)
    held = " with these joints held" if any(locked) else ""
    raise InputError(f"No other solution was found from {OTHER_STARTS} random starts{held}.")
