"""Damped least squares with constant damping: dq = J^T (J J^T + lambda I)^-1 e.

The step that minimises |J dq - e|^2 + lambda |dq|^2: finite everywhere, at the price of linear convergence.

References
----------
Wampler, *Manipulator inverse kinematic solutions based on vector formulations and damped least-squares methods*, 1986;
notes 5.107-5.115 (lambda as there, not squared).
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, damped_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the damped step."""
    damping = np.full(len(point.q), parameters["lambda"])
    return Move(damped_step(point, damping), damping)


ITERATION = IterationMethod(
    "dls_constant",
    "damped least squares, constant (Wampler)",
    6,
    step,
    (Parameter("lambda", "λ", "damping factor", 0.01, 0.0, 100.0, "sigma²"),),
)
