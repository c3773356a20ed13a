"""Gradient descent with a line search: dq = alpha J^T e, alpha chosen anew at every step.

It begins with the best alpha for the linearised error, e^T J J^T e / |J J^T e|^2, and halves it until the cost has
fallen by at least a part c of what the slope promises (Armijo). So it cannot diverge; it still stops where J^T e = 0.

References
----------
Notes 4.123-4.126; Armijo 1966; Nocedal and Wright, *Numerical Optimization*, algorithm 3.1.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters
from armlab.kin.ik.iterate.problem import Point, Problem

HALVINGS = 40
"""Largest number of halvings: after them the step is a trillionth of the first, and the slope is rounding."""


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the gradient step with the first alpha that reduces the cost enough; none when there is none."""
    slope = point.slope
    change = np.einsum("bmk,bk->bm", point.J, slope)
    square = np.einsum("bm,bm->b", change, change)
    alpha = np.einsum("bm,bm->b", point.e, change) / np.where(square > 0.0, square, np.inf)
    cost, promised = problem.half_square(point.e), np.einsum("bk,bk->b", slope, slope)
    trying = np.flatnonzero(alpha > 0.0)
    for _ in range(HALVINGS):
        if not len(trying):
            break
        landed = problem.land(point.q[trying], alpha[trying, None] * slope[trying])
        wanted = cost[trying] - parameters["c"] * alpha[trying] * promised[trying]
        trying = trying[~(problem.cost(landed) <= wanted)]
        alpha[trying] *= 0.5
    alpha[trying] = 0.0
    return Move(alpha[:, None] * slope)


ITERATION = IterationMethod(
    "gradient_search",
    "gradient (Jacobian transpose), line search",
    4,
    step,
    (Parameter("c", "c", "fraction of the predicted decrease that suffices", 1e-4, 1e-8, 0.5),),
)
