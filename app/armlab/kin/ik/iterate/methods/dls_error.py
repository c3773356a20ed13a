"""Damped least squares with damping in proportion to the cost: lambda = g e^T e / 2.

Far from the target it is a safe gradient step, close to it a Newton step; at a singularity that is no solution the
error, and with it the damping, stays.

References
----------
Chan and Lawrence, *General inverse kinematics with the error damped pseudoinverse*, 1988; notes 5.107-5.115.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, damped_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the step damped by the error."""
    damping = parameters["g"] * 0.5 * np.einsum("bm,bm->b", point.e, point.e)
    return Move(damped_step(point, damping), damping)


ITERATION = IterationMethod(
    "dls_error",
    "damped least squares, by error (Chan–Lawrence)",
    9,
    step,
    (Parameter("g", "g", "damping for each unit of ½ eᵀe", 1.0, 0.0, 1000.0),),
)
