"""Gauss-Newton: dq = gamma J# e with the pseudo-inverse of any J, square, wide or tall, singular or not.

It is the shortest of all steps that leave the smallest linearised error. Singular values below a cutoff count as zero,
so that it has a step even at a singularity, and jumps beside it.

References
----------
Notes 4.115-4.116 and 5.116-5.131; for m < n the printed formula should read J# = J^T (J J^T)^-1.
"""

from __future__ import annotations

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, inverse_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the pseudo-inverse step times gamma."""
    return Move(parameters["gamma"] * inverse_step(point, parameters["cutoff"]))


ITERATION = IterationMethod(
    "gauss_newton",
    "Gauss–Newton (pseudo-inverse)",
    5,
    step,
    (
        Parameter("gamma", "γ", "fraction of the step taken", 1.0, 0.01, 2.0),
        Parameter("cutoff", "ε", "singular values below this fraction of the largest count as zero", 1e-6, 0.0, 0.5),
    ),
)
