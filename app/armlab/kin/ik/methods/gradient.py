"""Gradient descent on H = |e|^2 / 2: dq = gain alpha J^T e, with alpha the best step along the linearised error.

Never needs an inverse and never jumps, converges linearly, and stops where e is in the null space of J^T.

References
----------
Notes 4.123-4.126; alpha is e.(J J^T e) / |J J^T e|^2.
"""

from __future__ import annotations

from collections.abc import Sequence

from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Number
from armlab.kin.ik.method import Method

TINY = 1e-30
"""Smallest divisor, which keeps alpha finite where J^T e vanishes; the step is zero there."""


def step(J: Sequence[Sequence[Number]], e: Sequence[Number], gain: Number) -> list[Number]:
    """Return the gradient step."""
    slope = [vec.dot(column, e) for column in vec.transpose(J)]
    change = [vec.dot(row, slope) for row in J]
    alpha = gain * vec.dot(e, change) / (vec.dot(change, change) + TINY)
    return [alpha * value for value in slope]


METHOD = Method("gradient", "gradient (Jacobian transpose)", 3, step, gain=1.0)
