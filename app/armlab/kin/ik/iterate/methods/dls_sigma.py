"""Damped least squares, damped only where the smallest singular value is small.

    lambda = lambda_max (1 - (sigma_min / epsilon)^2)   for sigma_min < epsilon, and 0 elsewhere

References
----------
After Nakamura and Hanafusa 1986; with sigma_min as in Chiaverini, Siciliano and Egeland, *Review of the damped
least-squares inverse kinematics with experiments on an industrial robot manipulator*, 1994; notes 5.107-5.115.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, damped_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the step damped by the smallest singular value."""
    damping = parameters["lambda_max"] * np.maximum(0.0, 1.0 - (point.sigma_min / parameters["epsilon"]) ** 2)
    return Move(damped_step(point, damping), damping)


ITERATION = IterationMethod(
    "dls_sigma",
    "damped least squares, by σ_min (Nakamura–Hanafusa)",
    8,
    step,
    (
        Parameter("lambda_max", "λ_max", "damping factor at a singularity", 0.01, 0.0, 100.0, "sigma²"),
        Parameter("epsilon", "ε", "smallest singular value below which it is damped", 0.2, 1e-6, 100.0, "sigma"),
    ),
)
