"""Descents from many random starts at once, for arms without a closed form: it finds, and proves nothing."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

STARTS = 256
STEPS = 40

DAMPING, FLOOR = 0.1, 1e-12
"""Of damped least squares: times the squared error, and at least."""

LONGEST = 1.5
"""Largest change of a joint in a step, radians or length scales."""

NEAR = 1e-7
"""Scaled error of a descent that is worth polishing."""


def many_starts(
    arm: Arm,
    G: NDArray[np.floating],
    *,
    seed: int = 0,
    starts: int = STARTS,
    inside: bool = False,
    held: dict[int, float] | None = None,
) -> Vector:
    """Return where descents arrived that came near the target, shape (k, n); angles as they came.

    Parameters
    ----------
    arm : Arm
    G : ndarray, shape (4, 4)
        Target in frame 0.
    seed, starts : int
    inside : bool
        Draw the starts inside the limits; turns from a whole turn otherwise. The descents know no limits.
    held : dict, optional
        Joints (0-based) that keep a value.
    """
    rng = np.random.default_rng(seed)
    low, width = task_error_of(arm).starts
    if not inside:
        low, width = np.where(arm.revolute, -math.pi, low), np.where(arm.revolute, math.tau, width)
    q = low + width * rng.random((starts, arm.n))
    free = np.ones(arm.n)
    for joint, value in (held or {}).items():
        q[:, joint], free[joint] = value, 0.0
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    done = []
    for _ in range(STEPS):
        J, e = _linearised(arm, q, G)
        size = np.einsum("ki,ki->k", e, e)
        arrived = size <= NEAR**2
        if arrived.any():
            done.append(q[arrived])
            q, J, e, size = q[~arrived], J[~arrived], e[~arrived], size[~arrived]
        if not len(q):
            break
        J = J * free
        normal = J @ np.swapaxes(J, 1, 2) + (DAMPING * size + FLOOR)[:, None, None] * np.eye(J.shape[1])
        step = np.einsum("kij,ki->kj", J, np.linalg.solve(normal, e[..., None])[..., 0])
        q = q + np.clip(step, -LONGEST, LONGEST) * scales
    return np.vstack(done) if done else np.empty((0, arm.n))


def _linearised(arm: Arm, q: Vector, G: NDArray[np.floating]) -> tuple[Vector, Vector]:
    """Return the scaled task Jacobian (k, m, n) and error (k, m) of a batch; see `armlab.kin.ik.problem.Posed`."""
    turn, L = arm.base[:3, :3].T, arm.length_scale
    tool = np.asarray(arm.fk(q), dtype=np.float64)
    R = turn @ tool[:, :3, :3]
    p = (tool[:, :3, 3] - arm.base[:3, 3]) @ turn.T
    whole = np.asarray(arm.jacobian(q), dtype=np.float64)
    linear, angular = turn @ whole[:, :3], turn @ whole[:, 3:]
    far = (G[:3, 3] - p)[:, arm.task.coordinates] / L
    rows, errors = [linear[:, arm.task.coordinates] / L], [far]
    kind = arm.task.rotation
    if kind != "none":
        turned = _turn(kind, R, np.asarray(G[:3, :3]))
        if kind == "phi":
            rows.append(angular[:, 2:])
            errors.append(turned[:, 2:])
        elif kind == "approach":
            rows.append(np.swapaxes(R[:, :, :2], 1, 2) @ angular)
            errors.append(np.einsum("kji,kj->ki", R[:, :, :2], turned))
        else:
            rows.append(angular)
            errors.append(turned)
    scales = np.where(arm.revolute, 1.0, L)
    return np.concatenate(rows, axis=1) * scales, np.concatenate(errors, axis=1)


def _turn(kind: str, R: Vector, wanted: Vector) -> Vector:
    """Return 2 sin(theta / 2) times the axis of the controlled turn to the wanted orientation, shape (k, 3)."""
    goal = wanted.copy()
    columns, weight = slice(0, 3), 0.5
    if kind == "approach":
        columns, weight = slice(2, 3), 1.0
    elif kind == "phi":
        goal[2] = 0.0
    present, goals = R[:, :, columns], np.broadcast_to(goal[:, columns], R[:, :, columns].shape)
    turned = weight * np.cross(present, goals, axis=1).sum(axis=2)
    cosine = weight * (present * goals).sum(axis=(1, 2)) - (0.5 if kind == "full" else 0.0)
    return np.asarray(turned / np.sqrt(np.abs(0.5 + 0.5 * cosine) + 1e-9)[:, None])
