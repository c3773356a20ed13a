"""The default task of an arm, from its geometry."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin import formulas
from armlab.kin.dh import Convention, Row
from armlab.kin.task import NAMED, Task, task_named

Floats = NDArray[np.float64]

SAMPLES = 16
"""Number of random configurations, with a fixed seed, that represent the generic one."""

NOTHING = 1e-9
"""Entry, or singular value, of a scaled Jacobian up to which it counts as zero."""


def default_task(rows: Sequence[Row], convention: Convention, tool: NDArray[np.float64]) -> Task:
    """Return the task an arm of this geometry is usually given.

    Axes all parallel to z0: the coordinates that can change, and the angle about z when a joint is left for it
    (2R: x, y; 3R: x, y, phi; SCARA: x, y, z, phi). Otherwise the pose from six joints on, position and approach
    direction with five that can do it (an arm whose hand only pitches and rolls cannot), and else the coordinates that
    can change. Where a modified table begins with a twist and all axes are parallel, but not to z0, the angle about
    them has no name in the axes of frame 0: only the coordinates remain.
    """
    arm = formulas.Description(tuple(rows), convention, np.eye(4), tool, task_named("pose"))
    J, R = _sampled(arm)
    moves = "".join(letter for k, letter in enumerate("xyz") if np.any(np.abs(J[:, k]) > NOTHING))
    turns_only_about_z = not np.any(np.abs(J[:, 3:5]) > NOTHING)
    if turns_only_about_z:
        spare = len(rows) > _rank(J[:, :3])
        phi = bool(np.any(np.abs(J[:, 5]) > NOTHING)) and (spare or not moves or len(rows) == 1)
        position = "" if phi and len(rows) == 1 else moves
        return task_named(f"{position} phi".strip() if phi else position)
    if len(rows) >= 6 and _rank(J) == 6:
        return task_named("pose")
    approach = np.concatenate([J[:, :3], np.swapaxes(R[:, :, :2], 1, 2) @ J[:, 3:]], axis=1)
    if len(rows) >= 5 and _rank(approach) == 5:
        return task_named("xyz approach")
    return NAMED.get(moves, task_named("xyz"))


def _sampled(arm: formulas.Description) -> tuple[Floats, Floats]:
    """Return Jacobians (SAMPLES, 6, n) and orientations of the tool (SAMPLES, 3, 3).

    Lengths, those of slides too, are in halves of the sum of all constant ones: the size of an arm counts for nothing.
    """
    lengths = [length for row in arm.rows for length in (row.a, row.d)]
    scale = (np.abs(lengths).sum() + float(np.linalg.norm(arm.tool[:3, 3]))) / 2.0 or 1.0
    units = np.where([row.revolute for row in arm.rows], 1.0, scale)
    q = np.random.default_rng(0).uniform(-3.0, 3.0, (SAMPLES, arm.n)) * units
    kernels = formulas.jacobian(arm), formulas.pose(arm)
    J, T = (np.array([kernel.scalar(*row) for row in q.tolist()]) for kernel in kernels)
    J = J.reshape(SAMPLES, 6, arm.n) * units
    J[:, :3] /= scale
    return J, T.reshape(SAMPLES, 4, 4)[:, :3, :3]


def _rank(J: Floats) -> int:
    return max(int(np.linalg.matrix_rank(matrix, tol=NOTHING)) for matrix in J)
