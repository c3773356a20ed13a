"""Solutions inside the joint limits, for lists in which there are none.

Only some points of a family are listed, and where branches merge rounding moves a solution by its root: each may put
outside what is inside. The solutions found here are exact, with a joint that is at its limit held there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.answer import Answer, in_order
from armlab.kin.ik.method import methods
from armlab.kin.ik.rest import AT
from armlab.kin.ik.search import Begin, inside_solutions
from armlab.kin.ik.solutions import beyond_limits, wrapped_rows
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import EXACT, distinct, polished

Vector = NDArray[np.float64]

NEARLY = 1e-3
"""Largest distance outside the limits, radians or length scales, of a solution that may be moved to the limit."""

ROUNDING = 1e-12
"""Largest scaled error of a solution that is moved to a limit."""

STARTS = 16
"""Number of starts of the search inside the limits, besides known members of a family."""

NEAREST = 4
"""Number of known members of a family that are used as starts."""


def exact_inside(arm: Arm, q: Vector, target: list[float], error: float = EXACT) -> Vector | None:
    """Return the exact solution at one that is inside the limits or nearly, None where it is not inside.

    A joint at its limit stays there if that leaves an exact solution, and moves inwards otherwise.
    """
    low, high = arm.limits.T
    q = np.clip(q, low, high)
    for _ in range(arm.n):
        best = polished(arm, q, target, (q <= low + AT) | (q >= high - AT))
        if best.errors.scaled2 > error**2:
            best = polished(arm, q, target)
        if best.errors.scaled2 > error**2 or float(np.abs(best.q - np.clip(best.q, low, high)).max()) > NEARLY:
            return None
        if arm.within_limits(best.q):
            return best.q
        q = np.clip(best.q, low, high)
    return None


def with_those_inside(arm: Arm, T: Vector, seed: int, answer: Answer) -> Answer:
    """Return the answer, with a solution inside the limits added if it had none and there is one."""
    if not answer.q:
        return answer
    rows, target = np.array(answer.q), task_error_of(arm).target(T)
    out = _sizes(arm, rows)
    if (out == 0.0).any():
        return answer
    nearly = [(k, exact_inside(arm, rows[k], target, ROUNDING)) for k in np.flatnonzero(out < NEARLY)]
    moved = {int(k): q for k, q in nearly if q is not None}
    if moved:
        return replace(answer, q=in_order(arm, [moved.get(k, row) for k, row in enumerate(rows)]))
    if answer.completeness == "complete":
        return answer
    found = _searched(arm, target, seed, np.vstack([rows, *answer.families]))
    if found is None:
        return answer
    # A member of a family may be as near to another as it likes; one of a list is replaced.
    others = [row for row in rows if len(distinct(arm, [found, row])) == 2]
    return replace(answer, q=in_order(arm, [*others, found]))


def _searched(arm: Arm, target: list[float], seed: int, known: Vector) -> Vector | None:
    """Return a solution found by descents inside the limits from known ones (k, n) and samples; None without one."""
    known = wrapped_rows(arm, known)
    low, high = arm.limits.T
    near = np.clip(known[np.argsort(_sizes(arm, known), kind="stable")[:NEAREST]], low, high)
    begins = [*(Begin(arm, start, None, seed, 1) for start in near), Begin(arm, None, None, seed, STARTS)]
    for begin in begins:
        for q in inside_solutions(begin, target, methods()["dls"], STARTS):
            found = exact_inside(arm, q, target)
            if found is not None:
                return found
    return None


def _sizes(arm: Arm, q: Vector) -> Vector:
    """Return the largest distances of rows (k, n) outside the limits, in radians and length scales, shape (k,)."""
    return np.asarray((np.abs(beyond_limits(arm, q)) / np.where(arm.revolute, 1.0, arm.length_scale)).max(axis=1))
