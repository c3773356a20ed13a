"""Use of all solutions when a search has failed: a solution after all, or the proof that there is none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.along_valley import solutions_along
from armlab.kin.ik.closed_form import closed_form_of, known_structure
from armlab.kin.ik.loop import wrapped
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve_all import solve_all

Floats = NDArray[np.float64]


class Known(NamedTuple):
    """The conclusion about a target.

    Attributes
    ----------
    q : ndarray, shape (n,), or None
        The solution inside the limits that is nearest to given values.
    proven : bool
        Whether there is none.
    sentence : str
        Sentence on the origin of the solution, or why there is none; empty when nothing is known.
    """

    q: Floats | None = None
    proven: bool = False
    sentence: str = ""


def known_solution(
    arm: Arm, T: Floats, near: Floats, locked: Sequence[bool] | None, crept: Sequence[float] | None = None
) -> Known:
    """Return the conclusion of the complete solver of an arm; an empty one for an arm that has none.

    That of an arm with joints to spare proves nothing, but may find what a search that came near missed, if there is
    none along the valley in which it crept.

    Parameters
    ----------
    arm : Arm
    T : ndarray, shape (4, 4)
        Checked pose in the world.
    near : ndarray, shape (n,)
        Joint values to be near to; those of locked joints are kept.
    locked : sequence of bool, optional
    crept : sequence of float, optional
        End of a search, if that is near the pose.
    """
    held = {i + 1: float(near[i]) for i in range(arm.n) if locked is not None and locked[i]}
    can_tell = _can_tell(arm, len(held))
    if not can_tell:
        if crept is None or held or arm.n <= arm.task.m:
            return Known()
        for row in solutions_along(arm, np.array(crept), T):
            q = _nearest(arm, row[None], near)
            if arm.within_limits(q):
                return Known(q, sentence="found along the valley in which this search crept")
    found = solve_all(arm, T, held=held)
    inside = found.q[found.within_limits]
    if len(inside):
        q = _nearest(arm, inside, near)
        q = q if locked is None else np.where(np.array(locked), near, q)
        return Known(q, sentence="found in the list of all solutions, not by this search")
    if not can_tell:
        return Known()
    so = " with these joints locked" if held else ""
    if found.completeness == "none" or (found.completeness == "complete" and not len(found)):
        return Known(None, True, f"proven: there is no solution{so}")
    if found.completeness == "complete":
        return Known(None, True, _outside(found) + so)
    return Known()


def _can_tell(arm: Arm, held: int) -> bool:
    """Return whether some solver can find all solutions with this number of held joints."""
    if arm.n - held > arm.task.m or known_structure(arm).free > held:
        return False
    general = arm.n == 6 and bool(arm.revolute.all()) and arm.task.key == "pose"
    return held > 0 or general or closed_form_of(arm) is not None


def _nearest(arm: Arm, q: Floats, near: Floats) -> Floats:
    """Return the row nearest to given values, with the nearest whole turns; distance in radians and length scales."""
    rows = np.array([wrapped(row.tolist(), near, arm.revolute, arm.limits) for row in q])
    return np.asarray(rows[int(np.argmin(_sizes(arm, rows - near)))])


def _outside(found: IkSolutions) -> str:
    nearest = int(np.argmin(_sizes(found.arm, found.beyond)))
    out = found.how_far_out[nearest]
    if len(found) == 1:
        return f"proven: the only solution is outside the limits, {out}"
    return f"proven: all {len(found)} solutions are outside the limits, the nearest has {out}"


def _sizes(arm: Arm, moves: Floats) -> Floats:
    """Return the lengths (k,) of joint moves (k, n) in radians and length scales."""
    return np.asarray(np.linalg.norm(moves / np.where(arm.revolute, 1.0, arm.length_scale), axis=1))
