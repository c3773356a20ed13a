"""Inverse kinematics.

`solve` finds one solution and `solve_batch` one for each of many poses, by any of the `methods` and
`iteration_methods`; `solve_all` finds all of them, `self_motion` the curve of a redundant arm; `judge` says what a
configuration is worth.

`iterate` runs a method as a lesson shows it, every step recorded, and `transpose_flow` the continuous scheme; `basins`
maps which solution a method reaches from where.
"""

from armlab.kin.ik.iterate import (
    Basins,
    Flow,
    IterationMethod,
    TaskVector,
    Trace,
    basins,
    iterate,
    iteration_method,
    iteration_methods,
    newton_1d,
    task_vector,
    transpose_flow,
)
from armlab.kin.ik.method import Method, method_named, methods
from armlab.kin.ik.poses import IkBatch, solve_batch
from armlab.kin.ik.self_motion import self_motion
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve import IkResult, solve
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.ik.verdict import Verdict, judge

__all__ = [
    "Basins",
    "Flow",
    "IkBatch",
    "IkResult",
    "IkSolutions",
    "IterationMethod",
    "Method",
    "TaskVector",
    "Trace",
    "Verdict",
    "basins",
    "iterate",
    "iteration_method",
    "iteration_methods",
    "judge",
    "method_named",
    "methods",
    "newton_1d",
    "self_motion",
    "solve",
    "solve_all",
    "solve_batch",
    "task_vector",
    "transpose_flow",
]
