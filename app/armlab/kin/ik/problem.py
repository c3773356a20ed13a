"""Error and Jacobian of a task at a target, compiled together with one step of a method.

Orientation errors are 2 sin(theta/2) r with theta, r the turn from the present to the wanted orientation: bounded, and
growing all the way to 180 degrees. Inside the algorithms positions are divided by the arm's length scale (half its
reach), which makes metres and radians comparable and the behaviour independent of the arm's size; results report the
two errors apart.

Here everything is compiled for speed: one configuration at a time, in 10 to 20 microseconds, behind every drag.
Iterations as lessons show them are in `armlab.kin.ik.iterate.problem`: many configurations at once, any task vector,
theta instead of 2 sin(theta/2), metres left alone where no radians meet them, and singular values. The two share no
code because they share no representation, expressions here and arrays there; a test holds them against each other.
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
from armlab.kin.ik.weights import Weights
from armlab.kin.transforms import inverse

FLOOR = 1e-13
"""Damping that keeps normal equations invertible at a singular pose that is also the solution. A larger one slows the
last digits near singularities: with 1e-9 three of a thousand random PUMA poses are lost."""


REACHED_M = 1e-6
REACHED_RAD = 1e-6
"""Errors, in metres and radians, within which a target counts as reached: far below what a classroom robot resolves."""


class Errors(NamedTuple):
    """Errors of a configuration with respect to a target, in the components of the task.

    Attributes
    ----------
    position2 : float
        Square of the distance, in m².
    rotation2 : float
        (2 sin(theta/2))² of the turn.
    per_square : float
        One over the square of the arm's length scale.
    weighted : float, optional
        Sum of the squares of the scaled and weighted components, where there are weights.
    """

    position2: float
    rotation2: float
    per_square: float
    weighted: float | None = None

    @property
    def position(self) -> float:
        """The distance in metres."""
        return math.sqrt(self.position2)

    @property
    def rotation(self) -> float:
        """The angle in radians."""
        return 2.0 * math.asin(min(1.0, math.sqrt(self.rotation2) / 2.0))

    @property
    def scaled2(self) -> float:
        """Squared scaled error without weights; a pure number."""
        return self.position2 * self.per_square + self.rotation2

    @property
    def cost(self) -> float:
        """Squared scaled error, with weights if there are any: only for comparing steps."""
        return self.scaled2 if self.weighted is None else self.weighted

    @property
    def reached(self) -> bool:
        """Whether both errors are within the tolerances of a reached target, whatever the size of the arm."""
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
        Vector from the tool point to the target.
    rotation : list of Number
        Components of 2 sin(theta/2) r that the task controls.
    turn : Vector
        sin(theta) r of the controlled turn: the downhill slope of 1 - cos(theta).
    overlap : 3 x 3
        Sum of r_k t_k^T over the controlled axes, weighted so that its trace is cos(theta) plus a constant.
    squares : list of Number
        Squared errors: position, rotation, rotation by its cosine, and with weights the weighted position.
    pulls : list of float
        Squared weight of each controlled coordinate over the squared length scale.
    turn_pull : float
        Squared weight of the orientation.
    free : list of Number
        For each joint 1 if it may move and 0 if not: inputs, or all 1.
    scales : list of float
        Size of a unit of each scaled joint variable: 1 rad, or the length scale in metres.
    """

    def __init__(self, arm: Arm, holds: bool, weights: Weights | None = None) -> None:
        graph, n = Graph(), arm.n
        linear, angular, tool = geometric_columns(arm.description, arm.description.chain(graph), ORIGIN)
        given = [graph.variable(n + k) for k in range(12)]
        wanted = Frame(*((given[c], given[4 + c], given[8 + c]) for c in range(4)))
        self.graph, self.linear, self.angular, self.tool = graph, linear, angular, tool
        self._coordinates = arm.task.coordinates
        of_place, of_turn = parted(arm, weights)
        self.pulls, self.turn_pull = [w**2 / arm.length_scale**2 for w in of_place], of_turn**2
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
        if weights is not None:
            self.squares.append(vec.dot(self.pulls, [value * value for value in controlled]))

    @property
    def slope(self) -> list[Number]:
        """Rate at which half the squared scaled distance falls with each scaled joint; 0 for joints not free."""
        far = [self.far[k] * pull for k, pull in zip(self._coordinates, self.pulls, strict=True)]
        moves = [[column[k] for k in self._coordinates] for column in self.linear]
        turns = [self.turn_pull * vec.dot(self.turn, axis) for axis in self.angular]
        falls = [vec.dot(far, move) + turn for move, turn in zip(moves, turns, strict=True)]
        return [fall * (free * scale) for fall, free, scale in zip(falls, self.free, self.scales, strict=True)]

    @property
    def cost(self) -> Number:
        """The squared scaled and weighted distance."""
        controlled = [self.far[k] for k in self._coordinates]
        return vec.dot(self.pulls, [value * value for value in controlled]) + self.turn_pull * self.squares[2]

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


def parted(arm: Arm, weights: Weights | None) -> tuple[Weights, float]:
    """Return the weights of the controlled coordinates and of the orientation."""
    places = len(arm.task.position)
    if weights is None:
        return (1.0,) * places, 1.0
    return weights[:places], weights[-1] if arm.task.rotation != "none" else 1.0


class TaskError:
    """Jacobian and error of an arm's task, compiled; both scaled to pure numbers, and weighted if asked."""

    def __init__(self, arm: Arm, weights: Weights | None = None) -> None:
        self.arm, self.weights, self._n = arm, weights, arm.n
        self._turn2 = parted(arm, weights)[1] ** 2

    @cached_property
    def starts(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower ends and widths of the ranges random starts are drawn from.

        The limits; of an angle that may turn farther than once only one turn, as near to (-pi, pi] as they allow.
        """
        low, high = self.arm.limits.T
        width = np.where(self.arm.revolute, np.minimum(high - low, 2.0 * math.pi), high - low)
        return np.where(self.arm.revolute, np.clip(-math.pi, low, high - width), low), width

    @cached_property
    def ranges(self) -> list[tuple[float, float, bool]]:
        """Limits of each joint, and whether it is revolute."""
        return [
            (low, high, row.revolute) for (low, high), row in zip(self.arm.limits.tolist(), self.arm.rows, strict=True)
        ]

    def target(self, T: NDArray[np.floating]) -> list[float]:
        """Return the 12 inputs of the formulas for a target pose (4, 4) in the world."""
        found: list[float] = self.in_frame_0(T).ravel().tolist()
        return found[:12]

    def in_frame_0(self, T: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return a pose (4, 4) of the world in frame 0."""
        return np.asarray(self._to_frame_0 @ T)

    def distance(self, target: Sequence[float]) -> float:
        """Return how far the controlled coordinates of a target are from the origin of frame 0, in metres."""
        return math.hypot(*[target[i] for i in self._places])

    @cached_property
    def _places(self) -> list[int]:
        return [4 * k + 3 for k in self.arm.task.coordinates]

    @cached_property
    def _to_frame_0(self) -> NDArray[np.float64]:
        return np.asarray(inverse(self.arm.base), dtype=np.float64)

    def at(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float] | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], Errors]:
        """Return J (m, n) and e (m), both scaled, and the errors; columns of joints that are not free are zero."""
        J, e, squares = self._parts(q, target, free)
        return J, e, self.errors(squares)

    def _parts(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float] | None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], Sequence[float]]:
        m, n = self.arm.task.m, self.arm.n
        numbers = self._scalar(*q, *target, *([1.0] * n if free is None else free))
        return np.array(numbers[: m * n]).reshape(m, n), np.array(numbers[m * n : m * n + m]), numbers[m * n + m :]

    def slope(
        self, q: Sequence[float], target: Sequence[float], free: Sequence[float]
    ) -> tuple[NDArray[np.float64], Errors]:
        """Return the exact negative gradient of half the squared scaled distance, (n), and the errors."""
        numbers, n = self._slope(*q, *target, *free), self.arm.n
        return np.array(numbers[:n]), self.errors(numbers[n:])

    @cached_property
    def _slope(self) -> Callable[..., tuple[float, ...]]:
        posed = Posed(self.arm, True, self.weights)
        return Kernel(posed.graph, [*posed.slope, *posed.squares], self._inputs()).scalar

    @cached_property
    def _scalar(self) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions()
        return Kernel(graph, [*(entry for row in J for entry in row), *e, *squares], self._inputs()).scalar

    def _inputs(self, holds: bool = True) -> int:
        """Return the number of inputs: q (n), the target (12) and, with ``holds``, 1 or 0 for a free or held joint."""
        return self.arm.n + 12 + (self.arm.n if holds else 0)

    def errors(self, squares: Sequence[float]) -> Errors:
        """Return the errors from the squares at the end of the formulas."""
        # Near 180 degrees the components of the turn vanish, near 0 the cosine loses digits: each where it is good.
        if self.weights is None:
            position2, rotation2, coarse2 = squares
            return Errors(position2, coarse2 if coarse2 > 1.0 else rotation2, self.per_square)
        position2, rotation2, coarse2, weighted = squares
        rotation2 = coarse2 if coarse2 > 1.0 else rotation2
        return Errors(position2, rotation2, self.per_square, weighted + self._turn2 * rotation2)

    @cached_property
    def per_square(self) -> float:
        """One over the square of the arm's length scale."""
        return self.arm.length_scale**-2

    def _expressions(self, holds: bool = True) -> tuple[Graph, list[list[Number]], list[Number], list[Number]]:
        """Return Jacobian and error, scaled and weighted, and the squared errors of `Posed`."""
        posed = Posed(self.arm, holds, self.weights)
        task, (of_place, of_turn) = self.arm.task, parted(self.arm, self.weights)
        units = [w / self.arm.length_scale for w in of_place] + [of_turn] * len(posed.rotation)
        J = task.jacobian_rows(posed.linear, posed.angular, posed.tool)
        for row, unit in zip(J, units, strict=True):
            row[:] = [entry * unit * (posed.free[i] * posed.scales[i]) for i, entry in enumerate(row)]
        e = [posed.far[k] for k in task.coordinates] + posed.rotation
        return posed.graph, J, [value * unit for value, unit in zip(e, units, strict=True)], posed.squares


class Problem(TaskError):
    """One arm and one method, compiled together, for any target."""

    def __init__(self, arm: Arm, method: Method, weights: Weights | None = None) -> None:
        super().__init__(arm, weights)
        self.method, self.gain, self.damped = method, method.gain, method.damped

    def linearise(
        self, q: Sequence[float], target: Sequence[float], gain: float, free: Sequence[float] | None
    ) -> Linearised:
        """Return one step at ``q`` and the errors there.

        ``free`` has 1 for joints that may move and 0 for others; None, the usual case, is compiled without it.
        """
        numbers, n = self.numbers(target, gain, free)(q), self._n
        return Linearised(numbers[n : 2 * n], self.errors(numbers[2 * n + 1 :]))

    def numbers(
        self, target: Sequence[float], gain: float, free: Sequence[float] | None
    ) -> Callable[[Sequence[float]], Sequence[float]]:
        """Return the function from q to plain numbers, quicker than objects.

        These are q after the step (n), the step (n), the sum of the squares of the step in scaled joint variables, and
        the squares for `errors`.
        """
        if not self.method.closed:
            return lambda q: self._stepped(q, target, gain, free)
        formulas, rest = (self._all_free, target) if free is None else (self._some_held, [*target, *free])
        return lambda q: formulas(*q, *rest, gain)

    def _stepped(
        self, q: Sequence[float], target: Sequence[float], gain: float, free: Sequence[float] | None
    ) -> Sequence[float]:
        J, e, squares = self._parts(q, target, free)
        step = [float(dq) for dq in self.method.step(J.tolist(), e.tolist(), gain)]
        # A column of zeros may come back with rounding in it: a held joint is to keep its last digit.
        step = [dq if may else 0.0 for dq, may in zip(step, free or [1.0] * self._n, strict=True)]
        moves = self._unscaled(step)
        return [*(x + dq for x, dq in zip(q, moves, strict=True)), *moves, vec.dot(step, step), *squares]

    def errors_at(self, q: Sequence[float], target: Sequence[float]) -> Errors:
        """Return the errors alone, in a third of the time."""
        return self.errors(self._squares(*q, *target))

    @cached_property
    def _squares(self) -> Callable[..., tuple[float, ...]]:
        posed = Posed(self.arm, False, self.weights)
        return Kernel(posed.graph, posed.squares, self._inputs(holds=False)).scalar

    @cached_property
    def _all_free(self) -> Callable[..., tuple[float, ...]]:
        return self._compiled(holds=False)

    @cached_property
    def _some_held(self) -> Callable[..., tuple[float, ...]]:
        return self._compiled(holds=True)

    def _compiled(self, holds: bool) -> Callable[..., tuple[float, ...]]:
        graph, J, e, squares = self._expressions(holds)
        inputs = self._inputs(holds)
        step = self.method.step(J, e, graph.variable(inputs))
        moves = self._unscaled(step)
        after = [graph.variable(i) + dq for i, dq in enumerate(moves)]
        return Kernel(graph, [*after, *moves, vec.dot(step, step), *squares], inputs + 1).scalar

    def _unscaled(self, step: Sequence[Any]) -> list[Any]:
        scale = self.arm.length_scale
        return [dq if row.revolute else dq * scale for row, dq in zip(self.arm.rows, step, strict=True)]
