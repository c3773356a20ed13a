"""Damped least squares with damping by error plus a bias: lambda = e^T e / 2 + b.

The bias keeps the normal equations well conditioned also where the error vanishes at a singular solution; it costs the
quadratic end, so it is small.

References
----------
Sugihara, *Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method*, 2011.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters, damped_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the step damped by the error and the bias."""
    damping = 0.5 * np.einsum("bm,bm->b", point.e, point.e) + parameters["b"]
    return Move(damped_step(point, damping), damping)


ITERATION = IterationMethod(
    "dls_bias",
    "damped least squares, error plus bias (Sugihara)",
    10,
    step,
    (Parameter("b", "b", "bias", 1e-3, 0.0, 100.0, "sigma²"),),
)
