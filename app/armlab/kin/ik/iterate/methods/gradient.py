"""Gradient descent on H = e^T e / 2 with a fixed step size: dq = alpha J^T e, the Jacobian transpose.

No inverse, and linear convergence. The notes say that it never diverges; with a fixed alpha it does as soon as
alpha > 2 / sigma_max^2, sigma_max the largest singular value of J. It stops wherever J^T e = 0, also at singular
configurations that are no solution.

References
----------
Notes 4.123-4.126, with the correction to the remark after 4.129.
"""

from __future__ import annotations

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters
from armlab.kin.ik.iterate.problem import Floats, Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return alpha J^T e."""
    return Move(parameters["alpha"] * point.slope)


def warn(problem: Problem, parameters: Parameters, sigma_max: Floats) -> str:
    """Return a sentence on the bound that alpha exceeds, or "" when it keeps it."""
    largest = float(sigma_max.max())
    if parameters["alpha"] * largest**2 <= 2.0:
        return ""
    unit = " m⁻²" if problem.sigma_unit == "m" else ""
    return f"the step size α = {parameters['alpha']:.3g}{unit} is above 2/σ_max² = {2.0 / largest**2:.3g}{unit}"


ITERATION = IterationMethod(
    "gradient",
    "gradient (Jacobian transpose), fixed step",
    3,
    step,
    (Parameter("alpha", "α", "step size", 0.3, 1e-4, 100.0, "1/sigma²"),),
    warn=warn,
)
