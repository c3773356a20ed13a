"""Scalar expressions as a directed acyclic graph.

Every arm's formulas are built once from its Denavit-Hartenberg constants with ordinary operators and then run or
printed by the back-ends beside this module. Nodes are hash-consed: the same sub-expression exists once, constants 0
and ±1 fold away, and signs are pulled out to the references, so ``-x`` costs nothing and ``a - b`` shares its node
with ``b - a``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

Node = tuple[Any, ...]
"""An operation, then node indices, then at most one constant (see `OPERATIONS`)."""

OPERATIONS: dict[str, int] = {
    "variable": 0,  # ("variable", index)
    "parameter": 0,  # ("parameter", name)
    "add": 2,
    "sub": 2,
    "mul": 2,
    "div": 2,
    "add_constant": 1,  # ("add_constant", x, c)    x + c
    "mul_constant": 1,  # ("mul_constant", x, c)    c x, c > 0 and not 1
    "constant_over": 1,  # ("constant_over", x, c)   c / x
    "neg": 1,
    "sin": 1,
    "cos": 1,
    "tan": 1,
    "sqrt": 1,
    "abs": 1,
}
"""Operations, each with how many of its arguments are nodes."""


def operands(node: Node) -> tuple[int, ...]:
    """Return the indices of the nodes from which this node is computed."""
    return node[1 : 1 + OPERATIONS[node[0]]]


class Graph:
    """A store of unique nodes. Make expressions with `variable` and combine them with operators."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._index: dict[Node, int] = {}

    def node(self, *parts: int | float | str) -> int:
        """Return the index of a node, which is made if it is new."""
        key: Node = parts
        index = self._index.get(key)
        if index is None:
            index = self._index[key] = len(self.nodes)
            self.nodes.append(key)
        return index

    def variable(self, index: int) -> Expression:
        """Return input number ``index``."""
        return Expression(self, 1, self.node("variable", index))

    def parameter(self, name: str) -> Expression:
        """Return a named constant, for formulas that are printed."""
        return Expression(self, 1, self.node("parameter", name))


@dataclass(frozen=True, slots=True, eq=False)
class Expression:
    """A signed reference to a node of a graph."""

    graph: Graph
    sign: int
    node: int

    def _signed(self, sign: int, *parts: int | float | str) -> Expression:
        return Expression(self.graph, sign, self.graph.node(*parts))

    def same_as(self, other: Number) -> bool:
        """Return whether both are the same node with the same sign; values are not compared."""
        return isinstance(other, Expression) and (self.sign, self.node) == (other.sign, other.node)

    def __neg__(self) -> Expression:
        return Expression(self.graph, -self.sign, self.node)

    def __add__(self, other: Number) -> Number:
        if not isinstance(other, Expression):
            if other == 0.0:
                return self
            return self._signed(self.sign, "add_constant", self.node, self.sign * float(other))
        if self.node == other.node:
            return 0.0 if self.sign != other.sign else self * 2.0
        if self.sign == other.sign:
            return self._signed(self.sign, "add", *sorted((self.node, other.node)))
        if self.node < other.node:
            return self._signed(self.sign, "sub", self.node, other.node)
        return self._signed(other.sign, "sub", other.node, self.node)

    def __radd__(self, other: float) -> Number:
        return self + other

    def __sub__(self, other: Number) -> Number:
        return self + (-other)

    def __rsub__(self, other: float) -> Number:
        return (-self) + other

    def __mul__(self, other: Number) -> Number:
        if not isinstance(other, Expression):
            if other == 0.0:
                return 0.0
            sign = self.sign if other > 0 else -self.sign
            size = abs(float(other))
            if size == 1.0:
                return Expression(self.graph, sign, self.node)
            return self._signed(sign, "mul_constant", self.node, size)
        return self._signed(self.sign * other.sign, "mul", *sorted((self.node, other.node)))

    def __rmul__(self, other: float) -> Number:
        return self * other

    def __truediv__(self, other: Number) -> Number:
        if not isinstance(other, Expression):
            return self * (1.0 / other)
        return self._signed(self.sign * other.sign, "div", self.node, other.node)

    def __rtruediv__(self, other: float) -> Number:
        if other == 0.0:
            return 0.0
        return self._signed(self.sign, "constant_over", self.node, float(other))


Number = float | Expression
"""A float, with which operations are computed at once, or an expression."""


def sin(x: Number) -> Number:
    """Return the sine; a minus sign of the argument is moved in front."""
    if not isinstance(x, Expression):
        return math.sin(x)
    return Expression(x.graph, x.sign, x.graph.node("sin", x.node))


def cos(x: Number) -> Number:
    """Return the cosine; a minus sign of the argument is dropped."""
    if not isinstance(x, Expression):
        return math.cos(x)
    return Expression(x.graph, 1, x.graph.node("cos", x.node))


def absolute(x: Number) -> Number:
    """Return the absolute value."""
    if not isinstance(x, Expression):
        return abs(x)
    return Expression(x.graph, 1, x.graph.node("abs", x.node))


def square_root(x: Number) -> Number:
    """Return the square root."""
    if not isinstance(x, Expression):
        return math.sqrt(x)
    inner = x.node if x.sign > 0 else x.graph.node("neg", x.node)
    return Expression(x.graph, 1, x.graph.node("sqrt", inner))


def live_nodes(graph: Graph, outputs: Iterable[Number]) -> list[int]:
    """Return the nodes that the outputs need, depth first, so that each value is needed for a short time only."""
    order: list[int] = []
    seen: set[int] = set()
    for output in outputs:
        if isinstance(output, Expression):
            _visit(graph, output.node, seen, order)
    return order


def _visit(graph: Graph, root: int, seen: set[int], order: list[int]) -> None:
    stack = [(root, False)]
    while stack:
        index, operands_done = stack.pop()
        if operands_done:
            order.append(index)
        elif index not in seen:
            seen.add(index)
            stack.append((index, True))
            stack.extend((i, False) for i in reversed(operands(graph.nodes[index])) if i not in seen)


def cost(graph: Graph, outputs: Iterable[Number]) -> float:
    """Return a measure of the work: 1 for an operation, 8 for a sine or cosine."""
    work = {"variable": 0.0, "parameter": 0.0, "sin": 8.0, "cos": 8.0}
    return sum(work.get(graph.nodes[i][0], 1.0) for i in live_nodes(graph, outputs))


def cheapest(builders: Iterable[Callable[[Graph], list[Number]]]) -> tuple[Graph, list[Number]]:
    """Return the variant with the least work among builders of the same formulas, each run in a graph of its own."""
    variants = []
    for build in builders:
        graph = Graph()
        variants.append((graph, build(graph)))
    return min(variants, key=lambda variant: cost(*variant))
