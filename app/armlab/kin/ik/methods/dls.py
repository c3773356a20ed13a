"""Damped least squares with damping proportional to the squared error (Levenberg-Marquardt).

    dq = J^T (J J^T + mu I)^-1 e,    mu = gain |e|^2 + floor

Far from the target it is a safe gradient step, close to it a Newton step that converges quadratically; at a singularity
the damping keeps it finite.

References
----------
Notes 5.107-5.115; Chan and Lawrence 1988; Sugihara 2011 for the error-dependent damping.
"""

from __future__ import annotations

from collections.abc import Sequence

from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Number
from armlab.kin.ik.method import Method
from armlab.kin.ik.problem import FLOOR


def step(J: Sequence[Sequence[Number]], e: Sequence[Number], gain: Number) -> list[Number]:
    """Return one damped step, by the smaller of the two systems of normal equations."""
    mu = damping(vec.dot(e, e), gain)
    columns = vec.transpose(J)
    wide = len(J) <= len(columns)
    vectors = J if wide else columns
    normal = [[vec.dot(a, b) for b in vectors] for a in vectors]
    for i, row in enumerate(normal):
        row[i] = row[i] + mu
    if wide:
        y = vec.solve_symmetric(normal, e)
        return [vec.dot(column, y) for column in columns]
    return vec.solve_symmetric(normal, [vec.dot(column, e) for column in columns])


def damping(square: Number, gain: Number) -> Number:
    """Return mu for e^T e = ``square``."""
    return square * gain + FLOOR


METHOD = Method("dls", "damped least squares", 1, step, gain=0.1, damping=damping)
