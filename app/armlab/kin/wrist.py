"""The centre of a spherical wrist: the point about which the last three joints turn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.relations import Axes


def wrist_centre(arm: Arm) -> NDArray[np.float64] | None:
    """Return the point where the last three joint axes meet, (3,), metres in tool axes; None where they do not.

    It is on the axis of the last joint and so fixed in the tool. The first joints alone place it, which is what
    planning for wrist and position apart rests on.

    References
    ----------
    Notes, end of section 6.3.2; Pieper 1968.
    """
    n, axes = arm.n, Axes(arm)
    if n < 3 or axes.last_triple(axes.meet) != n - 2:
        return None
    q = np.random.default_rng(0).uniform(arm.limits[:, 0], arm.limits[:, 1])
    T, J = arm.fk(q), arm.jacobian(q)
    # A turning joint moves the tool point by z x (p - o): the foot of p on its axis is p + z x v.
    z = J[3:, n - 3 :].T
    feet = T[:3, 3] + np.cross(z, J[:3, n - 3 :].T)
    across = np.eye(3) - z[:, :, None] * z[:, None, :]
    centre = np.linalg.solve(across.sum(axis=0), (across @ feet[:, :, None]).sum(axis=0)[:, 0])
    return np.asarray(T[:3, :3].T @ (centre - T[:3, 3]), dtype=np.float64)
