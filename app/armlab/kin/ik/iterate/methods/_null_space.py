"""Self-motion of redundant arms: a step that serves the task and, in its null space, a second objective.

    dq = J# e + (I - J# J) k grad(objective)

The second part is the nearest to the gradient of all that do not move the task vector, to first order.

References
----------
Notes 5.132-5.138; Liegeois, *Automatic supervisory control of the configuration and behavior of multibody mechanisms*,
1977.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import Move, inverse_step
from armlab.kin.ik.iterate.problem import Floats, Point

CUTOFF = 1e-6
"""Singular value, relative to the largest, below which a direction belongs to the null space as well."""

LONGEST = 0.1
"""Longest self-motion of one step, in scaled joints: its curvature then disturbs the task only a little."""


def towards(point: Point, wish: Floats) -> Move:
    """Return the task step plus the part of joint changes (B, k), in scaled joints, that leaves the task alone."""
    kept = (point.sigma > CUTOFF * point.sigma_max[:, None])[:, :, None] * point.Vt
    own = wish - np.einsum("brk,br->bk", kept, np.einsum("brk,bk->br", kept, wish))
    length = np.linalg.norm(own, axis=-1)
    shorter = np.minimum(1.0, LONGEST / np.where(length > 0.0, length, 1.0))
    secondary = length * shorter
    return Move(inverse_step(point, CUTOFF) + own * shorter[:, None], secondary=secondary)
