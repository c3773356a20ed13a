"""Run formulas for many configurations: a tape of in-place NumPy ufuncs on columns that stay in the cache.

Work goes through the batch in chunks; each node of the graph is one ufunc call on a whole chunk, its result lies in a
register (a row of a small scratch array) that is reused as soon as nobody needs it. The memory of that array is kept
for the next call: the system takes longer to hand out fresh pages than a short batch takes to compute.

In double precision NumPy's tangent is vectorised on common processors and its sine and cosine are not, so both come
from one tangent of the half angle: t = tan(x/2), r = 2 / (1 + t t), sin x = t r, cos x = r - 1. The absolute error
stays below 4e-16 and x = pi is not special, because the tangent of a rounded pi/2 is large but finite. In single
precision sine and cosine are the faster ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.graph.expression import Expression, Graph, Node, Number, absolute, live_nodes, operands, square_root
from armlab.kin.graph.scratch import KEPT

CHUNK = 4096
"""Configurations in one chunk: with some thirty registers of doubles they fill about 1 MiB, the second-level cache."""

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


PAD = 8
"""Padding, in doubles, of the rows of the scratch array: rows a power of two apart would share a few sets of the cache,
and transposing would take four times as long."""

FILLED = 3 << 20
"""Largest scratch memory of a chunk, in bytes: with many columns fewer configurations are evaluated at a time."""


class Place(NamedTuple):
    """The place of a value: an input column, a register, an output column, or a constant."""

    where: str
    at: float


class Step(NamedTuple):
    """One call of a NumPy ufunc."""

    ufunc: Callable[..., object]
    sources: tuple[Place, ...]
    target: Place


def half_angle(graph: Graph, outputs: Sequence[Number]) -> tuple[Graph, list[Number]]:
    """Return the same formulas in a new graph, with sine and cosine expressed by the tangent of the half angle."""
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
    """Free rows of the scratch array: they are taken and given back."""

    count: int = 0

    def __post_init__(self) -> None:
        self.free: list[int] = []

    def take(self) -> int:
        if self.free:
            return self.free.pop()
        self.count += 1
        return self.count - 1


class Tape:
    """Formulas compiled for arrays of one precision: a list of NumPy calls."""

    def __init__(self, graph: Graph, outputs: Sequence[Number], inputs: int, dtype: np.dtype[np.floating]) -> None:
        if dtype == np.float64:
            graph, outputs = half_angle(graph, outputs)
        self.dtype = dtype
        constants = {k: float(o) for k, o in enumerate(outputs) if not isinstance(o, Expression)}
        self.constants = np.array(list(constants), dtype=np.intp), np.array(list(constants.values()), dtype)
        self.inputs, self.width = inputs, len(outputs)
        self.steps: list[Step] = []
        self.registers = self._schedule(*_signs_turned(graph, outputs))
        self.literals, self._evaluate = self._compiled()

    def _schedule(self, nodes: Sequence[Node], order: Sequence[int], outputs: Sequence[Number]) -> int:
        """Fill the tape and return how many registers it needs, by a scan over the last uses of values."""
        last_use = {i: at for at, index in enumerate(order) for i in operands(nodes[index])}
        wanted: dict[int, list[tuple[int, int]]] = {}
        for k, output in enumerate(outputs):
            if isinstance(output, Expression):
                wanted.setdefault(output.node, []).append((k, output.sign))
        pool, place = _Registers(), dict[int, Place]()
        for at, index in enumerate(order):
            node = nodes[index]
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
            self._deliver(place[index], wanted.get(index, ()))
            if index not in last_use and place[index].where == "register":
                pool.free.append(int(place[index].at))
        return pool.count

    def _deliver(self, source: Place, wanted: Sequence[tuple[int, int]]) -> None:
        """Copy a value, with their signs, to the further outputs that need it."""
        for k, sign in wanted:
            if source != Place("output", k):
                self.steps.append(Step(_copy if sign > 0 else np.negative, (source,), Place("output", k)))

    def run(self, x: NDArray[np.floating], out: NDArray[np.floating]) -> None:
        """Evaluate ``x`` (N, inputs) into ``out`` (N, outputs); rows of x that are not finite give nan."""
        total, first, count = len(x), len(self.literals), self.inputs
        columns = first + count + self.registers + self.width
        size = min(CHUNK, FILLED // (columns * self.dtype.itemsize), max(total, 1))
        filled = columns * (size + PAD) * self.dtype.itemsize
        memory = KEPT.take(filled)
        scratch = memory[:filled].view(self.dtype).reshape(columns, size + PAD)
        inputs, outputs = scratch[first : first + count], scratch[first + count + self.registers :]
        scratch[:first] = self.literals[:, None]
        places, values = self.constants
        outputs[places] = values[:, None]
        for start in range(0, total, size):
            stop = min(start + size, total)
            used = stop - start
            if start == 0 or used < size:
                rows = list(scratch[:, :used])
            inputs[:, :used] = x[start:stop].T
            spoilt = _not_finite(inputs[:, :used])
            self._evaluate(*rows)
            out[start:stop] = outputs[:, :used].T
            if spoilt is not None:
                out[start:stop][spoilt] = np.nan
        KEPT.give_back(memory)

    def _compiled(self) -> tuple[NDArray[np.floating], Callable[..., None]]:
        """Return the constants, and the steps as a function of the rows of the scratch array.

        Straight-line code, since short batches would wait for a loop over the steps longer than for some of the
        arithmetic. Constants are rows, too, because a call with a number takes half as long again.
        """
        values = {p.at: None for step in self.steps for p in step.sources if p.where == "constant"}
        number = {Place("constant", at): k for k, at in enumerate(values)}
        first = {"input": len(values), "register": len(values) + self.inputs}
        first["output"] = first["register"] + self.registers

        def row(place: Place) -> str:
            return f"r{number[place] if place.where == 'constant' else first[place.where] + int(place.at)}"

        parameters = ", ".join(f"r{k}" for k in range(first["output"] + self.width))
        lines = [f"    {s.ufunc.__name__}({', '.join(map(row, (*s.sources, s.target)))})" for s in self.steps]
        namespace: dict[str, Any] = {step.ufunc.__name__: step.ufunc for step in self.steps}
        exec("\n".join([f"def evaluate({parameters}):", *lines, "    return"]), namespace)
        return np.array(list(values), self.dtype), namespace["evaluate"]


def _copy(source: NDArray[np.floating], target: NDArray[np.floating]) -> None:
    """Copy an array, in half the time of `numpy.positive`."""
    target[...] = source


def _not_finite(inputs: NDArray[np.floating]) -> NDArray[np.bool_] | None:
    """Return a mask of the columns that are not finite, set to zero to avoid warnings; None when all are finite."""
    finite = np.isfinite(inputs)
    if finite.all():
        return None
    spoilt: NDArray[np.bool_] = ~finite.all(axis=0)
    inputs[:, spoilt] = 0.0
    return spoilt


def _signs_turned(graph: Graph, outputs: Sequence[Number]) -> tuple[list[Node], list[int], list[Number]]:
    """Return nodes, order and outputs; differences that are only needed negated are written the other way round."""
    nodes, order, turned = list(graph.nodes), live_nodes(graph, outputs), list(outputs)
    shared = {i for index in order for i in operands(nodes[index])}
    shared |= {o.node for o in outputs if isinstance(o, Expression) and o.sign > 0}
    for k, output in enumerate(outputs):
        if isinstance(output, Expression) and output.node not in shared:
            node = graph.nodes[output.node]
            if node[0] == "sub":
                nodes[output.node] = ("sub", node[2], node[1])
                turned[k] = -output
    return nodes, order, turned


def _sources(node: Node, place: dict[int, Place]) -> tuple[Place, ...]:
    places = tuple(place[i] for i in operands(node))
    if node[0] in ("add_constant", "mul_constant"):
        return (*places, Place("constant", node[2]))
    if node[0] == "constant_over":
        return (Place("constant", node[2]), *places)
    return places
