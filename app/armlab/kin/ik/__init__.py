"""Inverse kinematics: `solve` for one solution, `judge` for what a configuration is worth, `methods` for the ways.

`iterate` runs a method as a lesson shows it, every step recorded; `basins` maps which solution it reaches from where.
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
from armlab.kin.ik.solve import IkResult, solve
from armlab.kin.ik.verdict import Verdict, judge

__all__ = [
    "IkResult",
    "Method",
    "Verdict",
    "judge",
    "method_named",
    "methods",
    "solve",
    "Basins",
    "Flow",
    "IterationMethod",
    "TaskVector",
    "Trace",
    "basins",
    "iterate",
    "iteration_method",
    "iteration_methods",
    "newton_1d",
    "task_vector",
    "transpose_flow",
]
