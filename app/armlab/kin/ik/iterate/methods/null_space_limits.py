"""Null-space projection with the objective to stay in the middle of the joint ranges.

    H = -1/(2n) sum ((q_i - middle_i) / (q_i,max - q_i,min))^2

References
----------
Liegeois 1977; Siciliano et al., *Robotics: Modelling, Planning and Control*, 3.5.1; notes 5.132-5.138.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters
from armlab.kin.ik.iterate.methods._null_space import towards
from armlab.kin.ik.iterate.problem import Floats, Point, Problem


def objective(problem: Problem, q: Floats) -> Floats:
    """Return H (B,) at configurations (B, n): 0 in the middle, -1/8 with all joints at their limits."""
    away, _ = _away(problem, q)
    return np.asarray(-np.sum(away**2, axis=-1) / (2.0 * problem.arm.n))


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the task step plus self-motion towards the middle."""
    away, ranges = _away(problem, point.q)
    gradient = -away / ranges / problem.arm.n
    return towards(point, parameters["k"] * gradient[:, problem.free] * problem.units)


def _away(problem: Problem, q: Floats) -> tuple[Floats, Floats]:
    """Return distances from the middle in units of the ranges, and the ranges; joints without one do not count."""
    low, high = problem.arm.limits.T
    ranges = np.where(high > low, high - low, 1.0)
    return np.where(high > low, (q - 0.5 * (low + high)) / ranges, 0.0), ranges


ITERATION = IterationMethod(
    "null_space_limits",
    "null-space projection, away from limits",
    12,
    step,
    (Parameter("k", "k", "gain of the self-motion", 30.0, 0.0, 10000.0),),
    objective=objective,
)
