"""Iterative inverse kinematics for lessons: every step unchanged, recorded in full.

The fast solver behind a drag is `armlab.kin.ik.solve`: its methods are compiled, it restarts and it minds the limits.
"""

from armlab.kin.ik.iterate.basins import Basins, basins
from armlab.kin.ik.iterate.flow import Flow, transpose_flow
from armlab.kin.ik.iterate.method import IterationMethod, Parameter, iteration_method, iteration_methods
from armlab.kin.ik.iterate.newton_1d import EXAMPLES, Example1D, Newton1D, Tangent, newton_1d
from armlab.kin.ik.iterate.record import iterate
from armlab.kin.ik.iterate.task_vector import TaskVector, task_vector
from armlab.kin.ik.iterate.trace import Trace

__all__ = [
    "iterate",
    "Trace",
    "TaskVector",
    "task_vector",
    "IterationMethod",
    "Parameter",
    "iteration_method",
    "iteration_methods",
    "basins",
    "Basins",
    "transpose_flow",
    "Flow",
    "newton_1d",
    "Newton1D",
    "Tangent",
    "Example1D",
    "EXAMPLES",
]
