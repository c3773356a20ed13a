"""Newton's method: dq = J^-1 e, and with more joints than components dq = J# e, the shortest step that removes e.

It converges quadratically from close by. Near a singularity det J is small, the step long and the next iterate
anywhere (notes 4.117-4.122); at one there is no step.

References
----------
Notes 4.111-4.116. For m < n the printed (J^T J)^-1 J^T never exists; right is J# = J^T (J J^T)^-1.
"""

from __future__ import annotations

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameters, inverse_step
from armlab.kin.ik.iterate.problem import Point, Problem


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the full step; it is refused where J has no inverse."""
    return Move(inverse_step(point), refused=point.singular)


ITERATION = IterationMethod("newton", "Newton", 1, step, tall=False)
