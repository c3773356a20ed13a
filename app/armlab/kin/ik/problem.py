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

FLOOR = 1e-13
"""Keeps normal equations invertible at a singular pose that is also the solution. A larger one slows the last digits
near singularities: with 1e-9 three of a thousand random PUMA poses are lost."""


REACHED_M = 1e-6
REACHED_RAD = 1e-6
"""Within these a target counts as reached: far below anything a picture or a classroom robot resolves."""


class Errors(NamedTuple):
    """How far a configuration is from a target, in the components the task controls.

    Attributes
    ----------
    position2 : float
        Square of the distance, in m².
    rotation2 : float
        (2 sin(theta/2))² of the turn.
    per_square : float
        One over the square of the arm's length scale.
    """

    position2: float
    rotation2: float
    per_square: float

    @property
    def position(self) -> float:
        """The distance in metres."""
        return math.sqrt(self.position2)

    @property
    def rotation(self) -> float:
        """The angle in radians."""
        return 2.0 * math.asin(min(1.0, math.sqrt(self.rotation2) / 2.0))

    @property
    def cost(self) -> float:
        """Squared scaled error; a pure number, only for comparing steps."""
        return self.position2 * self.per_square + self.rotation2

    @property
    def reached(self) -> bool:
        """Whether both are within what counts as reached, whatever the size of the arm."""
        return self.position2 < REACHED_M**2 and self.rotation2 < REACHED_RAD**2


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


class Posed:
    """An arm and a target as expressions, in the axes of frame 0.

    Attributes
    ----------
    linear, angular : list of Vector
        Columns of the geometric Jacobian.
    far : Vector
        From the tool point to the target.
    rotation : list of Number
        Components of 2 sin(theta/2) r that the task controls.
    turn : Vector
        sin(theta) r of the controlled turn: the downhill slope of 1 - cos(theta).
    overlap : 3 x 3
        Sum of r_k t_k^T over the controlled axes, weighted so that its trace is cos(theta) plus a constant.
    squares : list of Number
        Squared errors: position, rotation, and rotation by its cosine.
    free : list of Number
        For each joint 1 when it may move and 0 when not: inputs, or all 1.
    scales : list of float
        What a unit of the scaled joint variable is: 1 rad, or the length scale in metres.
    """

    def __init__(self, arm: Arm, holds: bool) -> None:
        graph, n = Graph(), arm.n
        linear, angular, tool = geometric_columns(arm.description, arm.description.chain(graph), ORIGIN)
        given = [graph.variable(n + k) for k in range(12)]
        wanted = Frame(*((given[c], given[4 + c], given[8 + c]) for c in range(4)))
        self.graph, self.linear, self.angular, self.tool = graph, linear, angular, tool
        self._length_scale, self._coordinates = arm.length_scale, arm.task.coordinates
        self.far = vec.subtract(wanted.p, tool.p)
        controlled = [self.far[k] for k in arm.task.coordinates]
        self.free: list[Number] = [graph.variable(n + 12 + i) if holds else 1.0 for i in range(n)]
        self.scales = [1.0 if row.revolute else arm.length_scale for row in arm.rows]
        cosine = self._compare_axes(arm.task.rotation, tool, wanted)
        # sin(theta) / sqrt((1 + cos(theta)) / 2) = 2 sin(theta/2); the 1e-9 keeps exact opposites (180 degrees) finite.
        by = 1.0 / square_root(absolute(0.5 + 0.5 * cosine + 1e-9))
        scaled: Vector = (self.turn[0] * by, self.turn[1] * by, self.turn[2] * by)
        self.rotation = arm.task.rotation_error(scaled, tool)
        coarse = 2.0 - 2.0 * cosine if self.rotation else 0.0
        self.squares = [vec.dot(controlled, controlled), vec.dot(self.rotation, self.rotation), coarse]

    @property
    def slope(self) -> list[Number]:
        """How fast half the squared scaled distance falls with each scaled joint variable, 0 for joints not free."""
        far = [self.far[k] / self._length_scale**2 for k in self._coordinates]
        moves = [[column[k] for k in self._coordinates] for column in self.linear]
        falls = [vec.dot(far, move) + vec.dot(self.turn, axis) for move, axis in zip(moves, self.angular, strict=True)]
        return [fall * (free * scale) for fall, free, scale in zip(falls, self.free, self.scales, strict=True)]

    @property
    def cost(self) -> Number:
        """The squared scaled distance."""
        return self.squares[0] / self._length_scale**2 + self.squares[2]

    def _compare_axes(self, kind: str, tool: Frame, wanted: Frame) -> Number:
        """Set ``turn`` and ``overlap`` and return cos(theta) of the controlled turn."""
        axes = list(zip((tool.x, tool.y, tool.z), (wanted.x, wanted.y, wanted.z), strict=True))
        if kind == "none":
            axes = []
        elif kind == "approach":
            axes = axes[2:]
        elif kind == "phi":
            axes = [(present, (goal[0], goal[1], 0.0)) for present, goal in axes]
        weight = 1.0 if kind == "approach" else 0.5
        turn: Vector = (0.0, 0.0, 0.0)
        overlap: list[list[Number]] = [[0.0] * 3 for _ in range(3)]
        for present, goal in axes:
            turn = vec.add(turn, vec.combine(weight, vec.cross(present, goal), 0.0, turn))
            for a in range(3):
                for b in range(3):
                    overlap[a][b] = overlap[a][b] + weight * (present[a] * goal[b])
        self.turn, self.overlap = turn, overlap
        if not axes:
            return 1.0
        trace = overlap[0][0] + overlap[1][1] + overlap[2][2]
        return trace - 0.5 if kind == "full" else trace


class TaskError:
    """Jacobian and error of an arm's task, compiled; both scaled to pure numbers."""

    def __init__(self, arm: Arm) -> None:
        self.arm = arm

    @cached_property
    def starts(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower ends and widths of the ranges random starts are drawn from.

        The limits; of an angle that may turn farther than once only one turn, as near to (-pi, pi] as they allow.
        """
        low, high = self.arm.limits.T
        width = np.where(self.arm.revolute, np.minimum(high - low, 2.0 * math.pi), high - low)
        return np.where(self.arm.revolute, np.clip(-math.pi, low, high - width), low), width

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

    def slope(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float]
    ) -> tuple[NDArray[np.float64], Errors]:
        """Return the exact downhill slope of half the squared scaled distance, (n), and the errors."""
        numbers = self._slope(*q, *target, *free)
        return np.array(numbers[:-3]), self._errors(numbers[-3:])

    @cached_property
    def _slope(self) -> Callable[..., tuple[float, ...]]:
        posed = Posed(self.arm, holds=True)
        return Kernel(posed.graph, [*posed.slope, *posed.squares], self._inputs()).scalar

    @cached_property
    def _scalar(self) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions()
        return Kernel(graph, [*(entry for row in J for entry in row), *e, *squares], self._inputs()).scalar

    def _inputs(self, holds: bool = True) -> int:
        """Inputs are q (n), the target (12), and with ``holds`` for each joint 1 when it is free and 0 when not."""
        return self.arm.n + 12 + (self.arm.n if holds else 0)

    def _errors(self, squares: Sequence[float]) -> Errors:
        position2, rotation2, coarse2 = squares
        # Near 180 degrees the components of the turn vanish, near 0 the cosine loses digits: each where it is good.
        return Errors(position2, coarse2 if coarse2 > 1.0 else rotation2, self._per_square)

    @cached_property
    def _per_square(self) -> float:
        return self.arm.length_scale**-2

    def _expressions(self, holds: bool = True) -> tuple[Graph, list[list[Number]], list[Number], list[Number]]:
        """Return scaled Jacobian and error, and three squared errors: position, rotation, rotation by its cosine."""
        posed = Posed(self.arm, holds)
        task, scale = self.arm.task, self.arm.length_scale
        J = task.jacobian_rows(posed.linear, posed.angular, posed.tool)
        for row in J[: len(task.position)]:
            row[:] = [entry / scale for entry in row]
        for i in range(self.arm.n):
            for row in J:
                row[i] = row[i] * (posed.free[i] * posed.scales[i])
        e = [posed.far[k] / scale for k in task.coordinates] + posed.rotation
        return posed.graph, J, e, posed.squares


class Problem(TaskError):
    """One arm and one method, compiled together; ask it about any target."""

    def __init__(self, arm: Arm, method: Method) -> None:
        super().__init__(arm)
        self.method, self.gain, self.damped = method, method.gain, method.damped

    def linearise(
        self, q: Sequence[float], target: Sequence[float], gain: float, free: Sequence[float] | None
    ) -> Linearised:
        """Return one step at ``q`` and the errors there.

        ``free`` has 1 for joints that may move and 0 for others; None, the usual case, is compiled without it.
        """
        if not self.method.closed:
            J, e, errors = self.at(q, target, free)
            return Linearised(self._unscaled(self.method.step(J.tolist(), e.tolist(), gain)), errors)
        numbers = self._all_free(*q, *target, gain) if free is None else self._some_held(*q, *target, *free, gain)
        return Linearised(numbers[:-3], self._errors(numbers[-3:]))

    @cached_property
    def _all_free(self) -> Callable[..., tuple[float, ...]]:
        return self._compiled(holds=False)

    @cached_property
    def _some_held(self) -> Callable[..., tuple[float, ...]]:
        return self._compiled(holds=True)

    def _compiled(self, holds: bool) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions(holds)
        inputs = self._inputs(holds)
        step = self._unscaled(self.method.step(J, e, graph.variable(inputs)))
        return Kernel(graph, [*step, *squares], inputs + 1).scalar

    def _unscaled(self, step: Sequence[Any]) -> list[Any]:
        scale = self.arm.length_scale
        return [dq if row.revolute else dq * scale for row, dq in zip(self.arm.rows, step, strict=True)]
