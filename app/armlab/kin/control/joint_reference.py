"""Joint values for a reference of the tool: inverse kinematics from sample to sample, each started at the one before.

References
----------
Notes 5.100-5.105; q_d for the scheme of 7.13-7.15.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.rate_inverse import pseudo_inverse_speeds
from armlab.kin.control.reference import JointAims, ToolAims
from armlab.kin.control.scaled_task import ScaledTask

Floats = NDArray[np.float64]

CLOSE = 1e-10
"""Scaled error below which a sample counts as reached."""

FIRST, LATER = 100, 12
"""Largest numbers of Newton iterations: for the first sample, which may be far from the start, and for the others."""

LONGEST = 0.5
"""Largest scaled joint change in one iteration: from far away Newton's method jumps."""

PIECE = 200
"""Samples in one piece of work: some 20 ms."""


class JointsFound(NamedTuple):
    """Joint values of the first samples of a reference.

    Attributes
    ----------
    aims : JointAims
        The N' <= N samples that were reached.
    reason : str
        Why not all; empty when all were.
    """

    aims: JointAims
    reason: str = ""


def joints_along(task: ScaledTask, aims: ToolAims, q0: Floats) -> Generator[None, None, JointsFound]:
    """Return joint values and rates for poses and twists of the tool; yield between pieces of the work.

    Parameters
    ----------
    task : ScaledTask
        The task of the arm that is to have these joint values.
    aims : ToolAims
        Wanted poses at N times.
    q0 : ndarray, shape (n,)
        Start of Newton's method for the first sample.
    """
    count = len(aims.poses)
    q, qdot = np.empty((count, task.n)), np.empty((count, task.n))
    here = q0
    for k in range(count):
        if k % PIECE == PIECE - 1:
            yield
        found = _reached(task, aims.poses[k], here, LATER if k else FIRST)
        if found is None:
            which = "the beginning of the reference" if k == 0 else "the reference from here on"
            return JointsFound(JointAims(q[:k], qdot[:k]), f"no joint values were found for {which}")
        here = q[k] = found
        R = task.pose(here)[:3, :3]
        parts = decomposed(task.scaled(task.jacobian(here, R)))
        qdot[k] = task.speeds(pseudo_inverse_speeds(parts, (task.rows(R) @ aims.twists[k]) * task.row_units))
    return JointsFound(JointAims(q, qdot))


def _reached(task: ScaledTask, wanted: Floats, q: Floats, most: int) -> Floats | None:
    """Return joint values near q that bring the tool to a pose, as far as the task asks; None if none are found."""
    for _ in range(most):
        pose = task.pose(q)
        error = task.error(wanted, pose) * task.row_units
        if np.abs(error).max(initial=0.0) < CLOSE:
            return q
        step = pseudo_inverse_speeds(decomposed(task.scaled(task.jacobian(q, pose[:3, :3]))), error)
        length = float(np.abs(step).max(initial=0.0))
        q = q + task.speeds(step * min(1.0, LONGEST / length) if length > 0.0 else step)
    final = task.error(wanted, task.pose(q)) * task.row_units
    return q if np.abs(final).max(initial=0.0) < CLOSE else None


def halfway(aims: JointAims, step: float) -> JointAims:
    """Return twice as many samples, (2N - 1, n), with those between on the cubic through values and rates."""
    q, qdot = aims
    between = 0.5 * (q[1:] + q[:-1]) + 0.125 * step * (qdot[:-1] - qdot[1:])
    rates = 1.5 * (q[1:] - q[:-1]) / step - 0.25 * (qdot[1:] + qdot[:-1])
    whole, slopes = np.empty((2 * len(q) - 1, q.shape[1])), np.empty((2 * len(q) - 1, q.shape[1]))
    whole[::2], whole[1::2], slopes[::2], slopes[1::2] = q, between, qdot, rates
    return JointAims(whole, slopes)
