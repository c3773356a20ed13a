"""Descents from many random starts at once, for arms without a closed form: they find solutions and prove nothing."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import damped_steps, many_at_once
from armlab.kin.ik.verdict import task_error_of

Vector = NDArray[np.float64]

STARTS = 256
STEPS = 40

DAMPING, FLOOR = 0.1, 1e-12
"""Damping of least squares as a factor of the squared error, and its smallest value."""

LONGEST = 1.5
"""Largest change of a joint in a step, radians or length scales."""

NEAR = 1e-7
"""Scaled error below which a descent is worth polishing."""


def many_starts(
    arm: Arm,
    G: NDArray[np.floating],
    *,
    seed: int = 0,
    starts: int = STARTS,
    inside: bool = False,
    held: dict[int, float] | None = None,
) -> Vector:
    """Return the ends of descents that came near the target, shape (k, n); angles are not wrapped.

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
    batch, done = many_at_once(arm), []
    for _ in range(STEPS):
        J, e = batch.linearised(q, G)
        size = np.einsum("ki,ki->k", e, e)
        arrived = size <= NEAR**2
        if arrived.any():
            done.append(q[arrived])
            q, J, e, size = q[~arrived], J[~arrived], e[~arrived], size[~arrived]
        if not len(q):
            break
        q = q + np.clip(damped_steps(J * free, e, DAMPING * size + FLOOR), -LONGEST, LONGEST) * scales
    return np.vstack(done) if done else np.empty((0, arm.n))
