"""Broyden's method: Newton's with a Jacobian that is computed once and then corrected by what each step showed.

    B <- B + (df - B dq) dq^T / (dq^T dq)

with df the observed change of the task vector: the smallest change of B that explains it. The first step is Newton's;
convergence is superlinear, without another Jacobian.

References
----------
Broyden, *A class of methods for solving nonlinear simultaneous equations*, 1965.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameters
from armlab.kin.ik.iterate.problem import SINGULAR, Floats, Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return B# e; the step is refused where B has no inverse."""
    B = _corrected(problem, point, memory) if memory else point.J
    # An iterate far away can spoil B; what is not finite is no matrix to invert.
    finite = np.asarray(np.all(np.isfinite(B), axis=(1, 2)))
    U, sigma, Vt = np.linalg.svd(np.where(finite[:, None, None], B, 0.0), full_matrices=False)
    refused = np.asarray(sigma[:, -1] <= SINGULAR * sigma[:, 0])
    kept = sigma > SINGULAR * sigma[:, :1]
    factors = np.where(kept, 1.0 / np.where(kept, sigma, 1.0), 0.0)
    dq = np.einsum("brk,br->bk", Vt, factors * np.einsum("bmr,bm->br", U, point.e))
    return Move(dq, refused=refused, memory=(B, point.e, point.q))


def _corrected(problem: Problem, point: Point, memory: Memory) -> Floats:
    B, e, q = memory
    dq = problem.travelled(q, point.q)
    square = np.einsum("bk,bk->b", dq, dq)
    missed = (e - point.e) - np.einsum("bmk,bk->bm", B, dq)
    change = missed[:, :, None] * dq[:, None, :] / np.where(square > 0.0, square, 1.0)[:, None, None]
    return np.asarray(B + change)


ITERATION = IterationMethod("broyden", "Broyden", 2, step, tall=False)
