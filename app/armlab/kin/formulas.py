"""The formulas of an arm, each built as expressions of its joint values q0 to q(n-1).

Where there are several ways to write the same thing, all are built and the one with the least work is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.kin.dh import Convention, Row, common_normals
from armlab.kin.graph import vector as vec
from armlab.kin.graph.chain import Chain, Constant, as_number
from armlab.kin.graph.expression import Graph, Number, absolute, cheapest, square_root
from armlab.kin.graph.kernel import Kernel
from armlab.kin.graph.vector import Vector
from armlab.kin.graph.walker import ORIGIN, Frame, Walker, exact
from armlab.kin.task import Task

MAX_MINORS = 8
"""Largest number of joints for which w of a redundant arm is the root of the sum of squared minors (never negative,
accurate near singularities); beyond, the number of minors grows too fast and det(J J^T) is factorised instead."""


@dataclass(frozen=True)
class Description:
    """Constants of an arm from which its formulas are made: rows, convention, base and tool poses, task."""

    rows: tuple[Row, ...]
    convention: Convention
    base: NDArray[np.float64]
    tool: NDArray[np.float64]
    task: Task

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.rows)

    def chain(self, graph: Graph, constant: Constant = as_number) -> Chain:
        """Return the table as expressions in a graph."""
        return Chain(graph, self.rows, self.convention, constant)

    @property
    def axes_parallel(self) -> bool:
        """Whether all joint axes are parallel to z of frame 0."""
        links = common_normals(self.rows, self.convention)[:-1]
        return all(exact(float(np.sin(alpha))) == 0.0 for _, alpha in links)


def position(arm: Description) -> Kernel:
    """Return p (3): the tool point in the world."""

    def forward(graph: Graph) -> list[Number]:
        return list(_tool_in_world(arm, graph).p)

    return _kernel(arm, *cheapest([forward, lambda graph: _position_backward(arm, graph)]))


def pose(arm: Description) -> Kernel:
    """Return the tool's pose in the world, 16 entries row by row."""
    graph = Graph()
    return _kernel(arm, graph, _matrix(_tool_in_world(arm, graph)))


def frames(arm: Description) -> Kernel:
    """Return the poses of frames 0 to n in the world, 16 entries each."""
    graph = Graph()
    chain = arm.chain(graph)
    return _kernel(arm, graph, [entry for frame in chain.frames(_base(arm)) for entry in _matrix(frame)])


def jacobian(arm: Description) -> Kernel:
    """Return the geometric Jacobian at the tool point in world axes, 6 n entries row by row."""
    graph = Graph()
    linear, angular, _ = geometric_columns(arm, arm.chain(graph), _base(arm))
    rows = [[column[k] for column in part] for part in (linear, angular) for k in range(3)]
    return _kernel(arm, graph, [entry for row in rows for entry in row])


def manipulability(arm: Description) -> Kernel:
    """Return the manipulability w of the task, shape (1,)."""

    def seen_from(k: int | None, graph: Graph) -> list[Number]:
        return [_volume(_task_jacobian(arm, graph, k))]

    axes: list[int | None] = [None]
    if (arm.task.position == "xyz" and arm.task.rotation != "phi") or (arm.axes_parallel and in_plane(arm.task)):
        axes += range(arm.n)
    return _kernel(arm, *cheapest([partial(seen_from, k) for k in axes]))


def geometric_columns(arm: Description, chain: Chain, start: Frame) -> tuple[list[Vector], list[Vector], Frame]:
    """Return linear and angular Jacobian columns at the tool point and the tool frame, in the axes of ``start``.

    References
    ----------
    Notes 5.56-5.65: (z; 0) for a prismatic joint, (z x (p_E - p); z) for a revolute one.
    """
    axes, walker = chain.axes(start)
    return _columns(arm, axes, walker)


def _columns(arm: Description, axes: Sequence[Frame], walker: Walker) -> tuple[list[Vector], list[Vector], Frame]:
    walker.place(arm.tool.tolist())
    tool = walker.frame()
    linear: list[Vector] = []
    angular: list[Vector] = []
    for row, axis in zip(arm.rows, axes, strict=True):
        if row.revolute:
            linear.append(vec.cross(axis.z, vec.subtract(tool.p, axis.p)))
            angular.append(axis.z)
        else:
            linear.append(axis.z)
            angular.append((0.0, 0.0, 0.0))
    return linear, angular, tool


def _task_jacobian(arm: Description, graph: Graph, k: int | None) -> list[list[Number]]:
    """Return the task Jacobian in the axes of frame 0 (k None) or of joint k.

    Turning the axes of all rows leaves w alone. For the full pose of an arm with six joints or more so does moving the
    point whose velocity is meant (the adjoint of a rigid motion has determinant 1), so the origin of the axes is taken
    and the tool drops out.
    """
    chain = arm.chain(graph)
    axes, walker = chain.axes() if k is None else chain.axes_seen_from(k)
    if arm.task.key == "pose" and arm.n >= arm.task.m:
        moments = [vec.cross(a.p, a.z) if row.revolute else a.z for row, a in zip(arm.rows, axes, strict=True)]
        turns = [a.z if row.revolute else (0.0, 0.0, 0.0) for row, a in zip(arm.rows, axes, strict=True)]
        return arm.task.jacobian_rows(moments, turns, ORIGIN)
    linear, angular, tool = _columns(arm, axes, walker)
    return arm.task.jacobian_rows(linear, angular, tool)


def _volume(J: list[list[Number]]) -> Number:
    """Return sqrt(det(J J^T)), or sqrt(det(J^T J)) of a tall J (notes, section 5.1.4), by Cauchy and Binet."""
    wide = J if len(J) <= len(J[0]) else vec.transpose(J)
    m, n = len(wide), len(wide[0])
    if m == n:
        return absolute(vec.maximal_minors(wide)[0])
    if n <= MAX_MINORS:
        minors = vec.maximal_minors(wide)
        return square_root(vec.dot(minors, minors))
    gram = [[vec.dot(a, b) for b in wide] for a in wide]
    return square_root(absolute(vec.maximal_minors(gram)[0]))


def in_plane(task: Task) -> bool:
    """Return whether turning the axes of all rows about z of frame 0 turns those of the task among themselves."""
    return task.position in ("", "xy", "xyz") and task.rotation in ("none", "phi")


def _position_backward(arm: Description, graph: Graph) -> list[Number]:
    """Return the tool point, carried from the last frame to the world: fewer operations than carrying the frames."""
    chain = arm.chain(graph)
    point: Vector = tuple(exact(value) for value in arm.tool[:3, 3].tolist())  # type: ignore[assignment]
    for i in reversed(range(arm.n)):
        point = _carried(partial(chain.link, i=i + 1), point)
        point = _carried(partial(chain.joint, i=i), point)
    point = _carried(partial(chain.link, i=0), point)
    return list(_carried(lambda walker: walker.place(arm.base.tolist()), point))


def _carried(move: Callable[[Walker], None], point: Vector) -> Vector:
    """Return the coordinates before a move of a point given after it."""
    walker = Walker()
    move(walker)
    x, y, z, p = walker.frame()
    turned = vec.along(vec.combine(point[0], x, point[1], y), point[2], z)
    return vec.add(turned, p)


def _tool_in_world(arm: Description, graph: Graph) -> Frame:
    _, walker = arm.chain(graph).axes(_base(arm))
    walker.place(arm.tool.tolist())
    return walker.frame()


def _base(arm: Description) -> Frame:
    walker = Walker()
    walker.place(arm.base.tolist())
    return walker.frame()


def _matrix(frame: Frame) -> list[Number]:
    top = [entry for k in range(3) for entry in (frame.x[k], frame.y[k], frame.z[k], frame.p[k])]
    return [*top, 0.0, 0.0, 0.0, 1.0]


def _kernel(arm: Description, graph: Graph, outputs: list[Number]) -> Kernel:
    return Kernel(graph, outputs, arm.n)
