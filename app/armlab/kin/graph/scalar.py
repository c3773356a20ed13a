"""Run formulas for one configuration: straight-line Python on floats, compiled once.

NumPy's overhead for one 4 x 4 product is larger than the whole forward kinematics written out in plain floats.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

from armlab.kin.graph.expression import Expression, Graph, Node, Number, live_nodes, operands

MAX_INLINE = 160
"""Longest sub-expression, in characters, written in place; CPython's parser limits the nesting of parentheses."""

_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
_BUILTINS = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "abs": abs}


def compile_scalar(graph: Graph, outputs: Sequence[Number], inputs: int) -> Callable[..., tuple[float, ...]]:
    """Return a function of ``inputs`` floats that returns the outputs as a tuple of floats."""
    namespace: dict[str, Any] = dict(_BUILTINS)
    exec(scalar_source(graph, outputs, inputs), namespace)
    compiled: Callable[..., tuple[float, ...]] = namespace["evaluate"]
    return compiled


def scalar_source(graph: Graph, outputs: Sequence[Number], inputs: int) -> str:
    """Return the source of the function: one line for each value used more than once."""
    order = live_nodes(graph, outputs)
    uses = Counter(i for index in order for i in operands(graph.nodes[index]))
    uses.update(o.node for o in outputs if isinstance(o, Expression))
    names: dict[int, str] = {}
    lines = [f"def evaluate({', '.join(f'x{i}' for i in range(inputs))}):"]
    for index in order:
        node = graph.nodes[index]
        text = _text(node, names)
        if node[0] == "variable" or (uses[index] == 1 and len(text) < MAX_INLINE):
            names[index] = text
        else:
            names[index] = f"v{index}"
            lines.append(f"    v{index} = {text}")
    results = ", ".join(_reference(o, names) for o in outputs)
    lines.append(f"    return ({results}{',' if len(outputs) == 1 else ''})")
    return "\n".join(lines)


def _text(node: Node, names: dict[int, str]) -> str:
    operation = node[0]
    if operation == "variable":
        return f"x{node[1]}"
    a = [names[i] for i in operands(node)]
    if operation in _INFIX:
        return f"({a[0]} {_INFIX[operation]} {a[1]})"
    if operation == "add_constant":
        return f"({a[0]} + {node[2]!r})"
    if operation == "mul_constant":
        return f"({a[0]} * {node[2]!r})"
    if operation == "constant_over":
        return f"({node[2]!r} / {a[0]})"
    if operation == "neg":
        return f"(-{a[0]})"
    return f"{operation}({a[0]})"


def _reference(output: Number, names: dict[int, str]) -> str:
    if not isinstance(output, Expression):
        return repr(float(output))
    return names[output.node] if output.sign > 0 else f"-{names[output.node]}"
