"""Damped least squares, damped only where the manipulability w is small.

    lambda = lambda_0 (1 - w / w_0)^2   for w < w_0, and 0 elsewhere

So it is Newton's step in the open and a damped one near singularities.

References
----------
Nakamura and Hanafusa, *Inverse kinematic solutions with singularity robustness*, 1986; notes 5.107-5.115, 5.144.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, damped_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the step damped by w."""
    lacking = np.maximum(0.0, 1.0 - point.w / parameters["w_0"])
    damping = parameters["lambda_0"] * lacking**2
    return Move(damped_step(point, damping), damping)


ITERATION = IterationMethod(
    "dls_w",
    "damped least squares, by w (Nakamura–Hanafusa)",
    7,
    step,
    (
        Parameter("lambda_0", "λ₀", "damping factor at a singularity", 0.01, 0.0, 100.0, "sigma²"),
        Parameter("w_0", "w₀", "manipulability below which it is damped", 0.05, 1e-6, 100.0, "w"),
    ),
)
