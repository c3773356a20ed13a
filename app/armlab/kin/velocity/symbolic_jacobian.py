"""The geometric Jacobian in symbols, where its entries are short enough to read."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.graph.chain import Chain
from armlab.kin.graph.expression import Expression, Graph, Number, cos, sin
from armlab.kin.graph.printing import Printer, Style, term_counts
from armlab.kin.graph.vector import Vector
from armlab.kin.symbolic import angle_offsets, rows_in_symbols, with_offsets

MOST_TERMS = 8
"""Largest number of terms of an entry."""

MOST_JOINTS = 4
"""Largest number of joints of an arm whose Jacobian is written: with more of them it fills pages."""

NOWHERE: Vector = (0.0, 0.0, 0.0)


def jacobian_formulas(arm: Arm, style: Style = "text") -> list[list[str]] | None:
    """Return the six rows of the geometric Jacobian at the tool point, in axes of frame 0; None when they are long.

    Parameters
    ----------
    arm : Arm
        Base is left out; the tool's constants appear as numbers.
    style : "text" or "latex"
        As in `armlab.kin.symbolic.pose_formulas`.

    References
    ----------
    Notes 5.56-5.65.

    Examples
    --------
    >>> jacobian_formulas(Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.8, 0.0, 0.0, 0.0)]))[0]
    ['-a1*sin(q1) - a2*sin(q1 + q2)', '-a2*sin(q1 + q2)']
    """
    if arm.n > MOST_JOINTS:
        return None
    graph, offsets = Graph(), angle_offsets(arm)
    columns = _columns(arm, graph)
    counts, show = term_counts(graph), Printer(graph, style)
    entries = [value for column in columns for part in column for value in part]
    if any(counts[value.node] > MOST_TERMS for value in entries if isinstance(value, Expression)):
        return None

    def written(value: Number) -> str:
        return with_offsets(show(value), offsets, style)

    return [[written(column[part][k]) for column in columns] for part in range(2) for k in range(3)]


def _columns(arm: Arm, graph: Graph) -> list[tuple[Vector, Vector]]:
    """Return the linear and the angular part of each column: derivatives of the position, and axes that turn."""
    chain = Chain(graph, rows_in_symbols(arm), arm.convention, lambda name, _value: graph.parameter(name))
    axes, walker = chain.axes()
    if not np.array_equal(arm.tool, np.eye(4)):
        walker.place(arm.tool.tolist())
    x, y, z = walker.frame().p
    columns: list[tuple[Vector, Vector]] = []
    for k, (row, axis) in enumerate(zip(arm.rows, axes, strict=True)):
        linear = derivative(x, k), derivative(y, k), derivative(z, k)
        columns.append((linear, axis.z if row.revolute else NOWHERE))
    return columns


def derivative(value: Number, k: int) -> Number:
    """Return the derivative of a sum of products of sines and cosines with respect to variable number k."""
    if not isinstance(value, Expression):
        return 0.0
    graph = value.graph
    operation, *inside = graph.nodes[value.node]
    if operation == "variable":
        return float(value.sign) if inside[0] == k else 0.0
    if operation == "parameter":
        return 0.0
    first = Expression(graph, value.sign, inside[0])
    if operation in ("sin", "cos"):
        angle = Expression(graph, 1, inside[0])
        outer = cos(angle) if operation == "sin" else -sin(angle)
        return outer * derivative(angle, k) * float(value.sign)
    if operation == "add_constant":
        return derivative(first, k)
    if operation == "mul_constant":
        return derivative(first, k) * float(inside[1])
    second = Expression(graph, 1, inside[1])
    if operation == "mul":
        return derivative(first, k) * second + first * derivative(second, k)
    if operation in ("add", "sub"):
        signed = second * float(value.sign if operation == "add" else -value.sign)
        return derivative(first, k) + derivative(signed, k)
    raise ValueError(f"no sum of products: {operation}")
