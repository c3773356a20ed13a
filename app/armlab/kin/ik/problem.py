"""Error and Jacobian of a task at a target, compiled together with one step of a method.

Orientation errors are 2 sin(theta/2) r with theta, r the turn from the present to the wanted orientation: bounded, and
growing all the way to 180 degrees. Inside the algorithms positions are divided by the arm's length scale (half its
reach), which makes metres and radians comparable and the behaviour independent of the arm's size; results report the
two errors apart.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.formulas import geometric_columns
from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Graph, Number, absolute, square_root
from armlab.kin.graph.kernel import Kernel
from armlab.kin.graph.vector import Vector
from armlab.kin.graph.walker import ORIGIN, Frame
from armlab.kin.ik.method import Method
from armlab.kin.transforms import inverse


class Errors(NamedTuple):
    """How far a configuration is from a target, in the components the task controls.

    Attributes
    ----------
    position : float
        Metres.
    rotation : float
        Radians.
    cost : float
        Squared scaled error; a pure number, only for comparing steps.
    """

    position: float
    rotation: float
    cost: float


class Linearised(NamedTuple):
    """The task at one configuration.

    Attributes
    ----------
    step : sequence of float
        Change of the joint values the method proposes, rad or m.
    errors : Errors
    """

    step: Sequence[float]
    errors: Errors


class TaskError:
    """Jacobian and error of an arm's task, compiled; both scaled to pure numbers."""

    def __init__(self, arm: Arm) -> None:
        self.arm = arm

    def target(self, T: NDArray[np.floating]) -> list[float]:
        """Return the 12 numbers of a target pose (4, 4) in the world, as the formulas want them."""
        in_frame_0 = inverse(self.arm.base) @ T
        return [float(value) for value in in_frame_0[:3].ravel()]

    def at(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float] | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], Errors]:
        """Return J (m, n) and e (m), both scaled, and the errors; columns of joints that are not free are zero."""
        m, n = self.arm.task.m, self.arm.n
        numbers = self._scalar(*q, *target, *([1.0] * n if free is None else free))
        J, e = np.array(numbers[: m * n]).reshape(m, n), np.array(numbers[m * n : m * n + m])
        return J, e, self._errors(numbers[m * n + m :])

    @cached_property
    def _scalar(self) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions()
        return Kernel(graph, [*(entry for row in J for entry in row), *e, *squares], self._inputs).scalar

    @property
    def _inputs(self) -> int:
        return 2 * self.arm.n + 12

    def _errors(self, squares: Sequence[float]) -> Errors:
        position2, rotation2, coarse2 = squares
        # Near 180 degrees the components of the turn vanish, near 0 the cosine loses digits: each where it is good.
        rotation2 = coarse2 if coarse2 > 1.0 else rotation2
        angle = 2.0 * math.asin(min(1.0, math.sqrt(rotation2) / 2.0))
        return Errors(math.sqrt(position2), angle, position2 * self._per_square + rotation2)

    @cached_property
    def _per_square(self) -> float:
        return self.arm.length_scale**-2

    def _expressions(self) -> tuple[Graph, list[list[Number]], list[Number], list[Number]]:
        """Return scaled Jacobian, scaled error, and three squared errors: position, rotation, rotation by its cosine.

        Inputs are q (n), the target (12), and for each joint 1 when it is free and 0 when it is not.
        """
        arm, graph = self.arm, Graph()
        n, scale = arm.n, arm.length_scale
        linear, angular, tool = geometric_columns(arm.description, arm.description.chain(graph), ORIGIN)
        given = [graph.variable(n + k) for k in range(12)]
        wanted = Frame(*((given[c], given[4 + c], given[8 + c]) for c in range(4)))
        J = arm.task.jacobian_rows(linear, angular, tool)
        far = vec.subtract(wanted.p, tool.p)
        position = [far[k] for k in arm.task.coordinates]
        rotation, coarse = _rotation_error(arm, tool, wanted)
        for row in J[: len(position)]:
            row[:] = [entry / scale for entry in row]
        for i, entry in enumerate(arm.rows):
            free = graph.variable(n + 12 + i) * (1.0 if entry.revolute else scale)
            for row in J:
                row[i] = row[i] * free
        e = [component / scale for component in position] + rotation
        return graph, J, e, [vec.dot(position, position), vec.dot(rotation, rotation), coarse]


class Problem(TaskError):
    """One arm and one method, compiled together; ask it about any target."""

    def __init__(self, arm: Arm, method: Method) -> None:
        super().__init__(arm)
        self.method = method

    def linearise(self, q: Sequence[float], target: Sequence[float], gain: float, free: Sequence[float]) -> Linearised:
        """Return one step at ``q`` and the errors there; ``free`` has 1 for joints that may move and 0 for others."""
        if not self.method.closed:
            J, e, errors = self.at(q, target, free)
            return Linearised(self._unscaled(self.method.step(J.tolist(), e.tolist(), gain)), errors)
        numbers = self._compiled(*q, *target, *free, gain)
        return Linearised(numbers[:-3], self._errors(numbers[-3:]))

    @cached_property
    def _compiled(self) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions()
        step = self._unscaled(self.method.step(J, e, graph.variable(self._inputs)))
        return Kernel(graph, [*step, *squares], self._inputs + 1).scalar

    def _unscaled(self, step: Sequence[Any]) -> list[Any]:
        scale = self.arm.length_scale
        return [dq if row.revolute else dq * scale for row, dq in zip(self.arm.rows, step, strict=True)]


def _rotation_error(arm: Arm, tool: Frame, wanted: Frame) -> tuple[list[Number], Number]:
    """Return the controlled components of 2 sin(theta/2) r, and (2 sin(theta/2))^2 = 2 - 2 cos(theta)."""
    kind = arm.task.rotation
    if kind == "none":
        return [], 0.0
    axes = zip((tool.x, tool.y, tool.z), (wanted.x, wanted.y, wanted.z), strict=True)
    pairs = [(tool.z, wanted.z)] if kind == "approach" else list(axes)
    turn: Vector = (0.0, 0.0, 0.0)
    cosines: Number = 0.0
    for present, goal in pairs:
        turn = vec.add(turn, vec.cross(present, goal))
        cosines = cosines + (vec.dot(present[:2], goal[:2]) if kind == "phi" else vec.dot(present, goal))
    if kind == "approach":  # one axis: |turn| = sin, cosines = cos
        turn, cosine_twice = vec.combine(2.0, turn, 0.0, turn), 2.0 * cosines
    elif kind == "phi":  # the projections of three axes on the xy plane: turn_z = 2 sin, cosines = 2 cos
        cosine_twice = cosines
    else:  # three axes: turn = 2 sin(theta) r, cosines = trace = 1 + 2 cos
        cosine_twice = cosines - 1.0
    # 2 sin(theta) / sqrt(2 + 2 cos(theta)) = 2 sin(theta/2); the 1e-9 keeps exact opposites (180 degrees) finite.
    by = 1.0 / square_root(absolute(2.0 + cosine_twice + 1e-9))
    scaled: Vector = (turn[0] * by, turn[1] * by, turn[2] * by)
    return arm.task.rotation_error(scaled, tool), 2.0 - cosine_twice
