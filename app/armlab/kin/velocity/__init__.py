"""Velocities: rigid bodies, rates of angles, Jacobians and their derivatives (sections 1.2 and 5.1 of the notes).

`subspaces` says what a Jacobian can do, `singularities` why an arm is singular in a configuration, `determinant` what
must vanish there; `answer` is the joint speeds for a wanted velocity.

>>> from armlab.kin.arm import Arm
>>> from armlab.kin.velocity import singularities
>>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
>>> [each.kind for each in singularities(arm, [0.4, 0.0])]
['elbow']
"""

from armlab.kin.velocity.answer import Answer, answer
from armlab.kin.velocity.dependence import Dependence, DeterminantTests, Minor, dependent_columns, determinant_tests
from armlab.kin.velocity.determinant import SymbolicDeterminant, SymbolicMinor, determinant
from armlab.kin.velocity.jacobians import (
    ToolMotion,
    analytic_jacobian,
    jacobian_acceleration,
    jacobian_at,
    jacobian_derivative,
    jacobian_rate,
    link_jacobian,
    tool_motion,
)
from armlab.kin.velocity.rates import angle_rates, rate_determinant, rate_matrix, singular_angles
from armlab.kin.velocity.rigid import angular_velocity, point_velocity, rotation_rate, turned_by, twist_at
from armlab.kin.velocity.singular import Singularity, singularities, usual_rank
from armlab.kin.velocity.subspaces import Subspaces, subspaces, task_axes, task_lengths, task_matrix, task_subspaces

__all__ = [
    "Answer",
    "Dependence",
    "DeterminantTests",
    "Minor",
    "Singularity",
    "Subspaces",
    "SymbolicDeterminant",
    "SymbolicMinor",
    "ToolMotion",
    "analytic_jacobian",
    "angle_rates",
    "angular_velocity",
    "answer",
    "dependent_columns",
    "determinant",
    "determinant_tests",
    "jacobian_acceleration",
    "jacobian_at",
    "jacobian_derivative",
    "jacobian_rate",
    "link_jacobian",
    "point_velocity",
    "rate_determinant",
    "rate_matrix",
    "rotation_rate",
    "singular_angles",
    "singularities",
    "subspaces",
    "task_axes",
    "task_lengths",
    "task_matrix",
    "task_subspaces",
    "tool_motion",
    "turned_by",
    "twist_at",
    "usual_rank",
]
