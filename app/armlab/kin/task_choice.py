"""The default task of an arm, from its geometry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.kin import formulas
from armlab.kin.dh import Convention, Row
from armlab.kin.graph.kernel import Kernel
from armlab.kin.task import NAMED, Task, task_named

SAMPLES = 16
"""Number of random configurations, with a fixed seed, that represent the generic one."""


def default_task(rows: Sequence[Row], convention: Convention, tool: NDArray[np.float64]) -> Task:
    """Return the task an arm of this geometry is usually given.

    Axes all parallel to z0: the coordinates that can change, and the angle about z when a joint is left for it
    (2R: x, y; 3R: x, y, phi; SCARA: x, y, z, phi). Otherwise the pose from six joints on, position and approach
    direction with five that can do it (an arm whose hand only pitches and rolls cannot), and else the coordinates that
    can change. Where a modified table begins with a twist and all axes are parallel, but not to z0, the angle about
    them has no name in the axes of frame 0: only the coordinates remain.
    """
    arm = formulas.Description(tuple(rows), convention, np.eye(4), tool, task_named("pose"))
    J = _sampled_jacobians(arm)
    moves = "".join(letter for k, letter in enumerate("xyz") if np.any(np.abs(J[:, k]) > 1e-9))
    turns_only_about_z = not np.any(np.abs(J[:, 3:5]) > 1e-9)
    if turns_only_about_z:
        spare = len(rows) > _rank(J[:, :3])
        phi = bool(np.any(np.abs(J[:, 5]) > 1e-9)) and (spare or not moves or len(rows) == 1)
        position = "" if phi and len(rows) == 1 else moves
        return task_named(f"{position} phi".strip() if phi else position)
    if len(rows) >= 6 and _rank(J) == 6:
        return task_named("pose")
    if len(rows) >= 5 and _manageable(arm, task_named("xyz approach")):
        return task_named("xyz approach")
    return NAMED.get(moves, task_named("xyz"))


def _sampled_jacobians(arm: formulas.Description) -> NDArray[np.float64]:
    return _sampled(formulas.jacobian(arm), arm.n).reshape(SAMPLES, 6, arm.n)


def _manageable(arm: formulas.Description, task: Task) -> bool:
    """Return whether the arm can move in all components of a task somewhere."""
    w = _sampled(formulas.manipulability(replace(arm, task=task)), arm.n)
    return bool(np.any(w > 1e-9))


def _sampled(kernel: Kernel, n: int) -> NDArray[np.float64]:
    rng = np.random.default_rng(0)
    return np.array([kernel.scalar(*rng.uniform(-3.0, 3.0, n).tolist()) for _ in range(SAMPLES)])


def _rank(J: NDArray[np.float64]) -> int:
    return max(int(np.linalg.matrix_rank(matrix, tol=1e-9)) for matrix in J)
