"""Run formulas for many configurations: a tape of in-place NumPy ufuncs on columns that stay in the cache.

Work goes through the batch in chunks; each node of the graph is one ufunc call on a whole chunk, its result lies in a
register (a row of a small scratch array) that is reused as soon as nobody needs it. Nothing else is allocated.

In double precision NumPy's tangent is vectorised on common processors and its sine and cosine are not, so both come
from one tangent of the half angle: t = tan(x/2), r = 2 / (1 + t t), sin x = t r, cos x = r - 1. The absolute error
stays below 4e-16 and x = pi is not special, because the tangent of a rounded pi/2 is large but finite. In single
precision sine and cosine are the faster ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.graph.expression import Expression, Graph, Node, Number, absolute, live_nodes, operands, square_root

CHUNK = 4096
"""Configurations at a time: with some thirty registers of doubles this fills about 1 MiB, the second-level cache."""

_UFUNCS: dict[str, np.ufunc] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "add_constant": np.add,
    "mul_constant": np.multiply,
    "constant_over": np.divide,
    "neg": np.negative,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sqrt": np.sqrt,
    "abs": np.absolute,
}


class Place(NamedTuple):
    """Where a value lies: an input column, a register, an output column, or a constant."""

    where: str
    at: float


class Step(NamedTuple):
    """One ufunc call."""

    ufunc: np.ufunc
    sources: tuple[Place, ...]
    target: Place


Call = tuple[np.ufunc, Callable[[Sequence[Any]], tuple[Any, ...]]]
"""A ufunc, and what picks its arguments from a list of all places."""


def half_angle(graph: Graph, outputs: Sequence[Number]) -> tuple[Graph, list[Number]]:
    """Return the same formulas in a new graph with sine and cosine written by the tangent of the half angle."""
    new = Graph()
    moved: dict[int, Number] = {}
    build: dict[str, Callable[..., Number]] = {
        "add": lambda a, b: a + b,
        "sub": lambda a, b: a - b,
        "mul": lambda a, b: a * b,
        "div": lambda a, b: a / b,
        "add_constant": lambda a, c: a + c,
        "mul_constant": lambda a, c: a * c,
        "constant_over": lambda a, c: c / a,
        "neg": lambda a: -a,
        "sqrt": square_root,
        "abs": absolute,
        "sin": lambda a: _tangent(a) * _reciprocal(a),
        "cos": lambda a: _reciprocal(a) - 1.0,
    }
    for index in live_nodes(graph, outputs):
        node = graph.nodes[index]
        if node[0] == "variable":
            moved[index] = new.variable(int(node[1]))
        else:
            constants = node[1 + len(operands(node)) :]
            moved[index] = build[node[0]](*(moved[i] for i in operands(node)), *constants)
    return new, [o.sign * moved[o.node] if isinstance(o, Expression) else o for o in outputs]


def _tangent(angle: Expression) -> Expression:
    half = angle * 0.5
    assert isinstance(half, Expression)
    return Expression(half.graph, half.sign, half.graph.node("tan", half.node))


def _reciprocal(angle: Expression) -> Number:
    t = _tangent(angle)
    return 2.0 / (t * t + 1.0)


@dataclass
class _Registers:
    """Hands out scratch rows and takes them back."""

    count: int = 0

    def __post_init__(self) -> None:
        self.free: list[int] = []

    def take(self) -> int:
        if self.free:
            return self.free.pop()
        self.count += 1
        return self.count - 1


class Tape:
    """Formulas compiled for arrays of one precision."""

    def __init__(self, graph: Graph, outputs: Sequence[Number], inputs: int, dtype: np.dtype[np.floating]) -> None:
        if dtype == np.float64:
            graph, outputs = half_angle(graph, outputs)
        self.dtype = dtype
        self.constants = [(k, float(o)) for k, o in enumerate(outputs) if not isinstance(o, Expression)]
        self.width = len(outputs)
        self.steps: list[Step] = []
        self.registers = self._schedule(graph, outputs)
        self.literals, self.calls = self._lined_up(inputs)

    def _schedule(self, graph: Graph, outputs: Sequence[Number]) -> int:
        """Fill the tape; return how many registers it needs (linear scan over last uses)."""
        order = live_nodes(graph, outputs)
        last_use = {i: at for at, index in enumerate(order) for i in operands(graph.nodes[index])}
        wanted: dict[int, list[tuple[int, int]]] = {}
        for k, output in enumerate(outputs):
            if isinstance(output, Expression):
                wanted.setdefault(output.node, []).append((k, output.sign))
        pool, place = _Registers(), dict[int, Place]()
        for at, index in enumerate(order):
            node = graph.nodes[index]
            if node[0] == "variable":
                place[index] = Place("input", node[1])
            else:
                used = operands(node)
                for i in set(used):
                    if last_use[i] == at and place[i].where == "register":
                        pool.free.append(int(place[i].at))
                direct = next((k for k, sign in wanted.get(index, ()) if sign > 0), None)
                place[index] = Place("register", pool.take()) if direct is None else Place("output", direct)
                self.steps.append(Step(_UFUNCS[node[0]], _sources(node, place), place[index]))
            self._deliver(index, place[index], wanted.get(index, ()))
            if index not in last_use and place[index].where == "register":
                pool.free.append(int(place[index].at))
        return pool.count

    def _deliver(self, index: int, source: Place, wanted: Sequence[tuple[int, int]]) -> None:
        """Copy a value to the further outputs that want it, with their signs."""
        for k, sign in wanted:
            if source != Place("output", k):
                ufunc = np.positive if sign > 0 else np.negative
                self.steps.append(Step(ufunc, (source,), Place("output", k)))

    def run(self, x: NDArray[np.floating], out: NDArray[np.floating]) -> None:
        """Evaluate ``x`` (N, inputs) into ``out`` (N, outputs)."""
        total = len(x)
        size = min(CHUNK, max(total, 1))
        inputs = np.empty((x.shape[1], size), self.dtype)
        registers = np.empty((self.registers, size), self.dtype)
        outputs = np.empty((self.width, size), self.dtype)
        for k, value in self.constants:
            outputs[k] = value
        for start in range(0, total, size):
            stop = min(start + size, total)
            used = stop - start
            inputs[:, :used] = x[start:stop].T
            rows = [*self.literals, *inputs[:, :used], *registers[:, :used], *outputs[:, :used]]
            for ufunc, arguments in self.calls:
                ufunc(*arguments(rows))
            out[start:stop] = outputs[:, :used].T

    def _lined_up(self, inputs: int) -> tuple[list[np.floating], list[Call]]:
        """Return the constants and the calls of the steps, whose list of all places begins with the constants.

        The list is made anew in each run, the choice from it only here: short batches would wait for it longer than
        for the arithmetic.
        """
        values = {p.at: None for step in self.steps for p in step.sources if p.where == "constant"}
        number = {Place("constant", at): k for k, at in enumerate(values)}
        first = {"input": len(values), "register": len(values) + inputs}
        first["output"] = first["register"] + self.registers

        def index(place: Place) -> int:
            return number[place] if place.where == "constant" else first[place.where] + int(place.at)

        calls: list[Call] = [(step.ufunc, itemgetter(*map(index, (*step.sources, step.target)))) for step in self.steps]
        return [self.dtype.type(at) for at in values], calls


def _sources(node: Node, place: dict[int, Place]) -> tuple[Place, ...]:
    places = tuple(place[i] for i in operands(node))
    if node[0] in ("add_constant", "mul_constant"):
        return (*places, Place("constant", node[2]))
    if node[0] == "constant_over":
        return (Place("constant", node[2]), *places)
    return places
