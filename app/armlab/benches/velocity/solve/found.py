"""Results for the wanted velocity: the answer, the subspaces, the tests of singularity."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.solve.state import Solve, arm_asked
from armlab.kin.arm import Arm
from armlab.kin.velocity.answer import Answer, answer_in, penrose
from armlab.kin.velocity.dependence import DeterminantTests, determinant_tests
from armlab.kin.velocity.determinant import SymbolicDeterminant, determinant
from armlab.kin.velocity.singular import Singularity, singularities, usual_rank
from armlab.kin.velocity.subspaces import Subspaces, matrix_subspaces, task_axes, task_matrix
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Found:
    """The solution of J qdot = v in one configuration.

    Attributes
    ----------
    arm : Arm
        Its task is what is asked.
    q : ndarray, shape (n,)
    J : ndarray, shape (m, n)
        Of the task, m/s and rad/s.
    v : ndarray, shape (m,)
    spaces : Subspaces
    answer : Answer
    """

    arm: Arm
    q: Array
    J: Array
    v: Array
    spaces: Subspaces
    answer: Answer

    @property
    def p(self) -> int:
        """Number of rows for the position."""
        return len(self.arm.task.position)

    @cached_property
    def axes(self) -> Array:
        """Unit vectors of the world along which the rows are components, (m, 3)."""
        return task_axes(self.arm, self.q)

    @property
    def usual(self) -> int:
        """The rank of J in configurations that are not singular."""
        return usual_rank(self.arm)

    @property
    def singular(self) -> bool:
        """Whether the rank is below the usual one."""
        return self.spaces.rank < self.usual

    @cached_property
    def reasons(self) -> tuple[Singularity, ...]:
        """Reasons why the configuration is singular."""
        return singularities(self.arm, self.q) if self.singular else ()

    @cached_property
    def tests(self) -> DeterminantTests:
        """The determinants of J, in metres and radians."""
        return determinant_tests(self.J)

    @property
    def formula(self) -> SymbolicDeterminant | None:
        """The determinant in symbols, for small arms."""
        return determinant(self.arm)

    @property
    def is_scaled(self) -> bool:
        """Whether metres or joint speeds are scaled for the rank, the singular values and the pseudo-inverse."""
        return bool((self.spaces.lengths != 1.0).any() or (self.spaces.speeds != 1.0).any())

    @property
    def scaled(self) -> Array:
        """The scaled matrix, (m, n), which is J itself if nothing is scaled."""
        return np.asarray(self.J * self.spaces.speeds / self.spaces.lengths[:, None])

    @property
    def scaled_inverse(self) -> Array:
        """The pseudo-inverse of the scaled matrix, (n, m)."""
        return np.asarray(self.spaces.inverse * self.spaces.lengths / self.spaces.speeds[:, None])

    @cached_property
    def penrose(self) -> tuple[float, float, float, float]:
        """The largest differences in the four Penrose conditions of the scaled matrix."""
        return penrose(self.scaled, self.scaled_inverse)

    def vectors(self, values: Array) -> tuple[Array, Array]:
        """Return a task velocity as two vectors of the world: of the tool point, m/s, and of rotation, rad/s."""
        return values[: self.p] @ self.axes[: self.p], values[self.p :] @ self.axes[self.p :]


def found_at(arm: Arm, q: Array, twist: tuple[float, ...]) -> Found:
    """Return the solution in one configuration; a longer twist is cut to the rows of the task."""
    J = task_matrix(arm, q)
    v = np.array(twist[: arm.task.m])
    spaces = matrix_subspaces(arm, J)
    return Found(arm, q, J, v, spaces, answer_in(spaces, J, v))


def found(state: State) -> Found:
    """Return the solution of a state."""
    return found_at(arm_asked(state), state[Joints].q, state[Solve].twist)
