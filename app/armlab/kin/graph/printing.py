"""Formulas printed for people: as text that Python can evaluate, or as LaTeX with the short forms of the books."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from armlab.kin.graph.expression import Expression, Graph, Node, Number, operands

Style = Literal["text", "latex"]

_SUM, _PRODUCT, _ATOM = 0, 1, 2

DIGITS = 12
"""Number of significant digits of numbers in formulas."""

GREEK = frozenset({"alpha", "beta", "gamma", "theta", "phi", "psi"})
"""Names of parameters that are Greek letters in LaTeX."""


@dataclass(frozen=True)
class _Text:
    """A printed node: its terms or factors, and the precedence of its operator."""

    parts: tuple[tuple[int, str], ...]  # of a sum: (sign, term); of a product: (rank, factor)
    binding: int
    number: float = 1.0  # of a product: the numbers in it, as one, since two side by side read as one in LaTeX


class Printer:
    """Prints the expressions of one graph.

    Parameters
    ----------
    graph : Graph
    style : "text" or "latex"
        ``a1*cos(q1) + a2*cos(q1 + q2)`` or ``a_1 c_1 + a_2 c_{12}``.
    """

    def __init__(self, graph: Graph, style: Style = "text") -> None:
        self.graph, self.latex = graph, style == "latex"
        self._known: dict[int, _Text] = {}

    def __call__(self, value: Number) -> str:
        """Return the printed expression."""
        if not isinstance(value, Expression):
            return self._number(value)
        return self._sum(self._signed_terms(value))

    def _node(self, index: int) -> _Text:
        if index not in self._known:
            self._known[index] = self._print(self.graph.nodes[index])
        return self._known[index]

    def _print(self, node: Node) -> _Text:
        operation = node[0]
        if operation in ("add", "sub", "add_constant"):
            return _Text(self._terms(node), _SUM)
        if operation in ("mul", "mul_constant"):
            return self._factors(node)
        return _Text(((self._rank(node), self._atom(node)),), _ATOM)

    def _terms(self, node: Node) -> tuple[tuple[int, str], ...]:
        left, *right = operands(node)
        terms = self._as_terms(left)
        if node[0] == "add_constant":
            constant = float(node[2])
            return (*terms, (1 if constant > 0 else -1, self._number(abs(constant))))
        sign = -1 if node[0] == "sub" else 1
        return terms + tuple((sign * s, text) for s, text in self._as_terms(right[0]))

    def _as_terms(self, index: int) -> tuple[tuple[int, str], ...]:
        printed = self._node(index)
        return printed.parts if printed.binding == _SUM else ((1, self._product(printed)),)

    def _signed_terms(self, value: Expression) -> tuple[tuple[int, str], ...]:
        return tuple((value.sign * sign, text) for sign, text in self._as_terms(value.node))

    def _factors(self, node: Node) -> _Text:
        factors: list[tuple[int, str]] = []
        number = float(node[2]) if node[0] == "mul_constant" else 1.0
        for index in operands(node):
            printed = self._node(index)
            number *= printed.number
            if printed.binding == _SUM:
                factors.append((3, f"({self._sum(printed.parts)})"))
            else:
                factors += printed.parts
        return _Text(tuple(sorted(factors, key=lambda factor: factor[0])), _PRODUCT, number)

    def _rank(self, node: Node) -> int:
        """Return the place of a factor in a product, behind its number: lengths, variables, functions, sums."""
        return {"parameter": 0, "variable": 1}.get(node[0], 2)

    def _product(self, printed: _Text) -> str:
        number = self._number(printed.number)
        factors = [text for _, text in printed.parts]
        return (" " if self.latex else "*").join(factors if number == "1" else [number, *factors])

    def _sum(self, terms: tuple[tuple[int, str], ...]) -> str:
        # A positive term comes first when there is one: "b - a", not "-a + b".
        ordered = sorted(terms, key=lambda term: term[0] < 0) if terms[0][0] < 0 else terms
        first = ("-" if ordered[0][0] < 0 else "") + ordered[0][1]
        return first + "".join(f" {'+' if sign > 0 else '-'} {text}" for sign, text in ordered[1:])

    def _atom(self, node: Node) -> str:
        operation = node[0]
        if operation == "variable":
            return self._symbol(f"q{int(node[1]) + 1}")
        if operation == "parameter":
            return self._symbol(str(node[1]))
        inside = [self._sum(self._as_terms(index)) for index in operands(node)]
        if operation == "neg":
            return f"(-({inside[0]}))"
        if operation in ("div", "constant_over"):
            over = inside if operation == "div" else [self._number(float(node[2])), inside[0]]
            return rf"\frac{{{over[0]}}}{{{over[1]}}}" if self.latex else f"(({over[0]})/({over[1]}))"
        if operation == "abs":
            return f"|{inside[0]}|" if self.latex else f"abs({inside[0]})"
        if operation == "sqrt":
            return rf"\sqrt{{{inside[0]}}}" if self.latex else f"sqrt({inside[0]})"
        return self._function(operation, inside[0])

    def _function(self, name: str, inside: str) -> str:
        if not self.latex:
            return f"{name}({inside})"
        joints = re.findall(r"q_\{?(\d+)\}?", inside)
        only_sum = inside == " + ".join(self._symbol(f"q{j}") for j in joints)
        if joints and only_sum and all(len(j) == 1 for j in joints) and name in ("sin", "cos"):
            return f"{name[0]}_{{{''.join(joints)}}}" if len(joints) > 1 else f"{name[0]}_{joints[0]}"
        return rf"\{name}({inside})"

    def _number(self, value: float) -> str:
        return latex_number(value) if self.latex else f"{value + 0.0:.{DIGITS}g}"  # + 0.0 turns -0.0 into 0

    def _symbol(self, name: str) -> str:
        """Return ``a12`` as it is or as ``a_{12}``, ``beta`` as ``\\beta``; ``cos(alpha2)`` is a symbol of its own."""
        if not self.latex:
            return name
        twist = re.fullmatch(r"(sin|cos)\((alpha)(\d+)\)", name)
        if twist:
            return rf"\{twist[1]}\alpha_{{{twist[3]}}}"
        letter, digits = re.fullmatch(r"([a-z]+?)(\d*)", name).groups()  # type: ignore[union-attr]
        letter = f"\\{letter}" if letter in GREEK else letter
        if not digits:
            return letter
        return f"{letter}_{digits}" if len(digits) == 1 else f"{letter}_{{{digits}}}"


def term_counts(graph: Graph) -> list[int]:
    """Return how many terms each node of a graph has when it is printed: the parts between plus and minus signs.

    Terms inside the parentheses of products count, those inside functions do not. Nothing is printed for it: a graph
    of some hundred nodes may print as millions of terms.
    """
    counts: list[int] = []
    for node in graph.nodes:
        inside = sum(counts[index] for index in operands(node))
        more = {"add": 0, "sub": 0, "add_constant": 1, "mul": -1, "mul_constant": 0}.get(node[0])
        counts.append(1 if more is None else inside + more)
    return counts


def latex_number(value: float, digits: int = DIGITS) -> str:
    r"""Return a number in LaTeX, with a power of ten where Python writes an exponent.

    >>> print(latex_number(-3.67e-6), latex_number(0.5))
    -3.67\cdot 10^{-6} 0.5
    """
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".partition("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}" if exponent else mantissa
