"""Null-space projection with the objective of a large manipulability w, away from singularities.

References
----------
Yoshikawa, *Analysis and control of robot manipulators with redundancy*, 1984; notes 5.132-5.138 and 5.144.
"""

from __future__ import annotations

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameter, Parameters
from armlab.kin.ik.iterate.methods._null_space import towards
from armlab.kin.ik.iterate.problem import Floats, Point, Problem

DIFFERENCE = 1e-5
"""Half the step of the central differences of w, in scaled joints; the error is about its square."""


def objective(problem: Problem, q: Floats) -> Floats:
    """Return w (B,), the product of the singular values of J as the method sees it."""
    return problem.manipulability(q)


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the task step plus self-motion up the slope of w."""
    k, B = len(problem.free), len(point.q)
    beside = np.repeat(point.q[None, :, :], 2 * k, axis=0)
    for i, joint in enumerate(problem.free):
        beside[2 * i, :, joint] += DIFFERENCE * problem.units[i]
        beside[2 * i + 1, :, joint] -= DIFFERENCE * problem.units[i]
    w = problem.manipulability(beside.reshape(-1, point.q.shape[1])).reshape(k, 2, B)
    slope = (w[:, 0] - w[:, 1]).T / (2.0 * DIFFERENCE)
    return towards(point, parameters["k"] * slope)


ITERATION = IterationMethod(
    "null_space_w",
    "null-space projection, large manipulability",
    13,
    step,
    (Parameter("k", "k", "gain of the self-motion", 0.2, 0.0, 1000.0),),
    objective=objective,
)
