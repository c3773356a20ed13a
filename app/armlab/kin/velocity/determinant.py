"""Determinants of small arms in symbols, such as l1 l2 sin q2, from the arm's own formulas."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.formulas import in_plane
from armlab.kin.graph import vector as vec
from armlab.kin.graph.chain import Chain
from armlab.kin.graph.expression import Graph
from armlab.kin.graph.vector import Vector
from armlab.kin.graph.walker import ORIGIN, Frame, Walker
from armlab.kin.symbolic import angle_offsets, rows_in_symbols
from armlab.kin.velocity._layout import layout_of
from armlab.kin.velocity._trigonometric import (
    Names,
    Product,
    Reader,
    TooLong,
    Trigonometric,
    latex_of,
    text_of,
)

MOST_JOINTS = 4
"""Largest number of joints that move the tool in its task, for an arm without a wrist."""

NEVER = 1e-9
"""Size of a column of the scaled Jacobian below which the joint never moves the tool: it has no minors."""

MOST_TERMS = 40
"""Largest number of terms of a determinant that is shown."""

Rows = list[list[Trigonometric]]


@dataclass(frozen=True)
class SymbolicMinor:
    """The determinant of some columns.

    Attributes
    ----------
    joints : tuple of int
        1-based.
    text : str
        Python with ``sin``, ``cos``, the joint variables ``q1`` ... and the `constants` of the arm.
    latex : str
        The same in LaTeX, with ``c_{23}`` for the cosine of q2 + q3, as in the notes.
    """

    joints: tuple[int, ...]
    text: str
    latex: str


@dataclass(frozen=True)
class SymbolicDeterminant:
    """The symbolic determinant, which vanishes where an arm is singular.

    Attributes
    ----------
    minors : tuple of SymbolicMinor
        One, the determinant, for as many joints as task components; else those of all choices of columns, but for
        joints that never move the tool in its task.
    square : bool
    """

    minors: tuple[SymbolicMinor, ...]
    square: bool


@lru_cache(maxsize=64)
def determinant(arm: Arm) -> SymbolicDeterminant | None:
    """Return the determinant, or the minors, of the task Jacobian in symbols; None for arms without a short one.

    Turning the axes in which velocities are written leaves a determinant alone, and so does, for a full pose, moving
    the point whose velocity is meant. So the axes are tried in turn and the shortest result is kept, and with a
    spherical wrist the point is its centre: the Jacobian is then block triangular. Behind three parallel axes it is
    the point where axes 5 and 6 meet.

    Parameters
    ----------
    arm : Arm
        Up to `MOST_JOINTS` joints that move the tool in its task of position and angle phi; or six, and the pose, with
        a spherical wrist, or with three parallel axes and a wrist whose last two axes meet.

    References
    ----------
    Notes 5.84-5.91 (2R and RRP), 4.83 (the elbow arm); Siciliano et al., *Robotics*, 3.3.2.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.8, 0.0, 0.0, 0.0)])
    >>> determinant(arm).minors[0].text
    'a1*a2*sin(q2)'
    """
    try:
        return _determinant(arm)
    except TooLong:
        return None


def _determinant(arm: Arm) -> SymbolicDeterminant | None:
    task, n = arm.task, arm.n
    layout = layout_of(arm)
    if layout.spherical and n == 6 and task.key == "pose":
        return _decoupled(arm)
    if layout.wrist is not None and layout.run and n == 6 and task.key == "pose":
        return _three_parallel(arm)
    moving = [k for k in range(n) if np.abs(layout.usual[:, :, k]).max() > NEVER]
    if len(moving) > MOST_JOINTS or task.rotation in ("approach", "full") or task.m > len(moving):
        return None
    whole = (arm.description.axes_parallel and in_plane(task)) or task.key == "xyz"
    views = [None, *range(n)] if whole else [None]
    found = [_minors(arm, columns, views) for columns in combinations(moving, task.m)]
    minors = tuple(minor for minor in found if minor is not None)
    return SymbolicDeterminant(minors, task.m == n) if len(minors) == len(found) else None


def _minors(arm: Arm, columns: tuple[int, ...], views: Sequence[int | None]) -> SymbolicMinor | None:
    products = []
    for view in views:
        with suppress(TooLong):
            products.append(determinant_of(_task_rows(arm, view, columns)))
    if not products:
        raise TooLong
    return _shortest(arm, columns, products)


def _shortest(arm: Arm, columns: Sequence[int], products: Sequence[Product]) -> SymbolicMinor | None:
    best = min(products, key=lambda product: product.size)
    if best.terms > MOST_TERMS:
        return None
    names = Names(arm.n, angle_offsets(arm))
    return SymbolicMinor(tuple(k + 1 for k in columns), text_of(best, names), latex_of(best, names))


def _decoupled(arm: Arm) -> SymbolicDeterminant | None:
    """Return det J = det J_11 det J_22: the first three joints move the wrist centre, the last three turn the hand."""
    firsts, lasts = [], []
    for view in (None, *range(6)):
        graph, axes, _ = _symbolic_axes(arm, view)
        linear, angular = _columns(arm, axes, axes[4].p)
        read = Reader(graph, arm.n, arm.revolute.tolist())
        firsts.append(determinant_of([[read(column[k]) for column in linear[:3]] for k in range(3)]))
        lasts.append(determinant_of([[read(column[k]) for column in angular[3:]] for k in range(3)]))
    first, last = (min(products, key=lambda product: product.size) for products in (firsts, lasts))
    minor = _shortest(arm, range(6), [first.times(last)])
    return None if minor is None else SymbolicDeterminant((minor,), True)


def _three_parallel(arm: Arm) -> SymbolicDeterminant | None:
    """Return det J where axes 2, 3, 4 are parallel and axes 5, 6 meet in a point that neither of them moves."""
    products = []
    for view in (None, *range(6)):
        graph, axes, _ = _symbolic_axes(arm, view)
        linear, angular = _columns(arm, axes, axes[5].p)
        read = Reader(graph, arm.n, arm.revolute.tolist())
        with suppress(TooLong):
            products.append(
                determinant_of([[read(column[k]) for column in part] for part in (linear, angular) for k in range(3)])
            )
    if not products:
        raise TooLong
    minor = _shortest(arm, range(6), products)
    return None if minor is None else SymbolicDeterminant((minor,), True)


def _task_rows(arm: Arm, view: int | None, columns: tuple[int, ...]) -> Rows:
    graph, axes, walker = _symbolic_axes(arm, view)
    if not np.array_equal(arm.tool, np.eye(4)):
        walker.place(arm.tool.tolist())
    tool = walker.frame()
    linear, angular = _columns(arm, axes, tool.p)
    rows = arm.task.jacobian_rows(linear, angular, tool)
    read = Reader(graph, arm.n, arm.revolute.tolist())
    return [[read(row[k]) for k in columns] for row in rows]


def _symbolic_axes(arm: Arm, view: int | None) -> tuple[Graph, list[Frame], Walker]:
    """Return the joint axes in axes of frame 0, or in those of joint ``view`` before it moves."""
    graph = Graph()
    chain = Chain(graph, rows_in_symbols(arm), arm.convention, lambda name, _value: graph.parameter(name))
    axes, walker = chain.axes(ORIGIN) if view is None else chain.axes_seen_from(view)
    return graph, axes, walker


def _columns(arm: Arm, axes: Sequence[Frame], point: Vector) -> tuple[list[Vector], list[Vector]]:
    """Return the linear and the angular columns at a point. Notes 5.56-5.65."""
    linear: list[Vector] = []
    angular: list[Vector] = []
    for row, axis in zip(arm.rows, axes, strict=True):
        if row.revolute:
            linear.append(vec.cross(axis.z, vec.subtract(point, axis.p)))
            angular.append(axis.z)
        else:
            linear.append(axis.z)
            angular.append((0.0, 0.0, 0.0))
    return linear, angular


def determinant_of(rows: Rows) -> Product:
    """Return the determinant as a product: single entries of a row, columns and blocks become factors."""
    n = len(rows)
    for i, j in _places(n):
        row = [k for k in range(n) if not rows[i][k].is_zero]
        column = [k for k in range(n) if not rows[k][j].is_zero]
        if not row or not column:
            return Product.of(Trigonometric.number(0.0, rows[0][0].joints))
        if row == [j] or column == [i]:
            rest = [[rows[a][b] for b in range(n) if b != j] for a in range(n) if a != i]
            factor = rows[i][j] if (i + j) % 2 == 0 else -rows[i][j]
            return Product.of(factor).times(determinant_of(rest)) if rest else Product.of(factor)
    for size in range(2, n - 1):
        for chosen in combinations(range(n), size):
            filled = [k for k in range(n) if any(not rows[i][k].is_zero for i in chosen)]
            if len(filled) == size:
                return _block(rows, chosen, filled)
    return Product.of(_laplace(rows))


def _block(rows: Rows, chosen: Sequence[int], filled: Sequence[int]) -> Product:
    """Return the determinant where the chosen rows have as many non-zero columns: the product of both blocks."""
    n = len(rows)
    others, rest = [i for i in range(n) if i not in chosen], [k for k in range(n) if k not in filled]
    sign = 1.0 if (sum(chosen) + sum(filled)) % 2 == 0 else -1.0
    blocks = sorted([(list(filled), list(chosen)), (rest, others)])
    first, last = (determinant_of([[rows[i][k] for k in columns] for i in places]) for columns, places in blocks)
    whole = first.times(last)
    return replace(whole, number=sign * whole.number)


def _places(n: int) -> Iterator[tuple[int, int]]:
    return ((i, j) for i in range(n) for j in range(n))


def _laplace(rows: Rows) -> Trigonometric:
    if len(rows) == 1:
        return rows[0][0]
    total = Trigonometric.number(0.0, rows[0][0].joints)
    for j, entry in enumerate(rows[0]):
        if not entry.is_zero:
            minor = _laplace([[row[k] for k in range(len(rows)) if k != j] for row in rows[1:]])
            total = total + entry * minor if j % 2 == 0 else total - entry * minor
    return total
