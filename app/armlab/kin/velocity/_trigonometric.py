"""Sums of products of lengths with cosines and sines of sums of angles: exact algebra, in which everything cancels.

A term is a number times powers of symbols times exp(i k.q) with whole k: products of cosines and sines become sums of
them, each in one form only, so that equal things are equal and what cancels is gone.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from armlab.kin.graph.expression import Expression, Graph, Node, Number, operands
from armlab.kin.graph.printing import latex_number

Powers = tuple[tuple[str, int], ...]
Turns = tuple[int, ...]
Terms = dict[tuple[Powers, Turns], complex]

LONGEST = 1500
"""Largest number of products of terms in one multiplication; longer sums do not help a reader, and take seconds."""


class TooLong(Exception):
    """A sum has too many terms."""


NOTHING = 1e-12
"""Factor of a term below which it is the rounding of zero."""


@dataclass(frozen=True, eq=False)
class Trigonometric:
    """A real sum of terms.

    Attributes
    ----------
    terms : dict
        Powers of symbols and multiples of the joint angles, to a complex factor; conjugate multiples come in pairs.
    joints : int
        Number of joints.
    """

    terms: Terms
    joints: int

    @classmethod
    def number(cls, value: float, joints: int) -> Trigonometric:
        return cls({((), (0,) * joints): complex(value)} if value else {}, joints)

    @classmethod
    def symbol(cls, name: str, joints: int) -> Trigonometric:
        return cls({(((name, 1),), (0,) * joints): 1.0 + 0.0j}, joints)

    @classmethod
    def wave(cls, turns: Turns, sine: bool) -> Trigonometric:
        """Return the cosine or the sine of a sum of whole multiples of the joint angles."""
        back = tuple(-k for k in turns)
        if turns == back:
            return cls.number(0.0 if sine else 1.0, len(turns))
        one: complex = -0.5j if sine else 0.5
        return cls({((), turns): one, ((), back): one.conjugate()}, len(turns))

    @property
    def is_zero(self) -> bool:
        """Whether the sum has no terms."""
        return not self.terms

    def __neg__(self) -> Trigonometric:
        return Trigonometric({key: -factor for key, factor in self.terms.items()}, self.joints)

    def __add__(self, other: Trigonometric) -> Trigonometric:
        total = dict(self.terms)
        for key, factor in other.terms.items():
            total[key] = total.get(key, 0.0) + factor
        return Trigonometric(_cleaned(total), self.joints)

    def __sub__(self, other: Trigonometric) -> Trigonometric:
        return self + (-other)

    def __mul__(self, other: Trigonometric) -> Trigonometric:
        if len(self.terms) * len(other.terms) > LONGEST:
            raise TooLong
        total: Terms = {}
        for (powers, turns), factor in self.terms.items():
            for (more, further), times in other.terms.items():
                key = _times(powers, more), tuple(a + b for a, b in zip(turns, further, strict=True))
                total[key] = total.get(key, 0.0) + factor * times
        return Trigonometric(_cleaned(total), self.joints)


def _cleaned(terms: Terms) -> Terms:
    return {key: factor for key, factor in terms.items() if abs(factor) > NOTHING}


def _times(a: Powers, b: Powers) -> Powers:
    powers = dict(a)
    for name, power in b:
        powers[name] = powers.get(name, 0) + power
    return tuple(sorted(powers.items()))


class Reader:
    """Reads expressions of a graph.

    Parameters
    ----------
    graph : Graph
    joints : int
    revolute : sequence of bool
        Variables of joints that turn may stand in sines and cosines only, those of slides outside of them only.
    """

    def __init__(self, graph: Graph, joints: int, revolute: Sequence[bool]) -> None:
        self._graph, self._joints, self._revolute = graph, joints, revolute
        self._known: dict[int, Trigonometric] = {}

    def __call__(self, value: Number) -> Trigonometric:
        """Return an expression as a sum."""
        if not isinstance(value, Expression):
            return Trigonometric.number(value, self._joints)
        found = self._node(value.node)
        return found if value.sign > 0 else -found

    def _node(self, index: int) -> Trigonometric:
        if index not in self._known:
            self._known[index] = self._read(self._graph.nodes[index])
        return self._known[index]

    def _read(self, node: Node) -> Trigonometric:
        operation = node[0]
        if operation == "variable":
            return Trigonometric.symbol(f"q{node[1] + 1}", self._joints)
        if operation == "parameter":
            return Trigonometric.symbol(str(node[1]), self._joints)
        if operation in ("sin", "cos"):
            return Trigonometric.wave(self._turns(node[1]), operation == "sin")
        inside = [self._node(index) for index in operands(node)]
        if operation == "add":
            return inside[0] + inside[1]
        if operation == "sub":
            return inside[0] - inside[1]
        if operation == "mul":
            return inside[0] * inside[1]
        constant = Trigonometric.number(float(node[2]), self._joints)
        if operation == "add_constant":
            return inside[0] + constant
        if operation == "mul_constant":
            return inside[0] * constant
        raise ValueError(f"no sum of products: {operation}")

    def _turns(self, index: int) -> Turns:
        """Return the multiples of the joint angles in the argument of a sine or cosine."""
        node = self._graph.nodes[index]
        if node[0] == "variable" and self._revolute[node[1]]:
            return tuple(int(k == node[1]) for k in range(self._joints))
        if node[0] not in ("add", "sub"):
            raise ValueError(f"no sum of joint angles: {node[0]}")
        sign = 1 if node[0] == "add" else -1
        first, second = (self._turns(each) for each in operands(node))
        return tuple(a + sign * b for a, b in zip(first, second, strict=True))


@dataclass(frozen=True, eq=False)
class Product:
    """A product of sums.

    Attributes
    ----------
    number : float
    powers : tuple
        Symbols before everything else.
    factors : tuple of Trigonometric
        Without a common number or symbol; none is a mere number.
    """

    number: float
    powers: Powers
    factors: tuple[Trigonometric, ...]

    @classmethod
    def of(cls, whole: Trigonometric) -> Product:
        """Return a sum as a product, with common factors of all terms in front."""
        if whole.is_zero:
            return cls(0.0, (), ())
        common: dict[str, int] = dict(next(iter(whole.terms))[0])
        for powers, _ in whole.terms:
            given = dict(powers)
            common = {name: min(power, given.get(name, 0)) for name, power in common.items()}
        common = {name: power for name, power in common.items() if power}
        reduced = {(_without(powers, common), turns): factor for (powers, turns), factor in whole.terms.items()}
        size = _scale(reduced)
        scaled = Trigonometric({key: factor / size for key, factor in reduced.items()}, whole.joints)
        plain = len(scaled.terms) == 1 and all(not powers and not any(turns) for powers, turns in scaled.terms)
        number = size * next(iter(scaled.terms.values())).real if plain else size
        return cls(number, tuple(sorted(common.items())), () if plain else (scaled,))

    def times(self, other: Product) -> Product:
        if self.number == 0.0 or other.number == 0.0:
            return Product(0.0, (), ())
        return Product(self.number * other.number, _times(self.powers, other.powers), self.factors + other.factors)

    @property
    def terms(self) -> int:
        """Number of terms of its factors when they are printed."""
        return sum(len(_waves(factor)) for factor in self.factors)

    @property
    def size(self) -> tuple[int, int]:
        """Length of the printed form: number of terms, then of angles in them."""
        angles = sum(abs(k) for factor in self.factors for _, turns, _, _ in _waves(factor) for k in turns)
        return self.terms, angles


def _without(powers: Powers, common: dict[str, int]) -> Powers:
    left = ((name, power - common.get(name, 0)) for name, power in powers)
    return tuple((name, power) for name, power in left if power)


def _scale(terms: Terms) -> float:
    """Return the signed factor of the first wave if all are equal in magnitude; else only the sign."""
    waves = _waves(Trigonometric(terms, 0))
    sizes = [factor for _, _, _, factor in waves]
    if max(map(abs, sizes)) - min(map(abs, sizes)) <= NOTHING:
        return sizes[0]
    return 1.0 if sizes[0] > 0.0 else -1.0


Wave = tuple[Powers, Turns, bool, float]
"""Symbols, multiples of the angles, whether it is a sine, and the factor."""


def _waves(whole: Trigonometric) -> list[Wave]:
    """Return the terms as cosines and sines, each angle once, in a fixed order."""
    found: list[Wave] = []
    for (powers, turns), factor in whole.terms.items():
        if not any(turns):
            found.append((powers, turns, False, factor.real))
        elif next(k for k in turns if k) > 0:
            for sine, value in ((False, 2.0 * factor.real), (True, -2.0 * factor.imag)):
                if abs(value) > NOTHING:
                    found.append((powers, turns, sine, value))
    return sorted(found, key=lambda wave: (wave[0], [-abs(k) for k in wave[1]], wave[2]))


# -- printing --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Names:
    """Names of the joint variables.

    Attributes
    ----------
    joints : int
    offsets : dict of float
        Constant parts of the angles of some joints, rad, by joint (1-based), that the formulas do not hold.
    """

    joints: int
    offsets: dict[int, float]


def text_of(product: Product, names: Names) -> str:
    """Return a product as Python."""
    return _printed(product, names, False)


def latex_of(product: Product, names: Names) -> str:
    """Return a product as LaTeX, with the short forms of the books."""
    return _printed(product, names, True)


def _printed(product: Product, names: Names, latex: bool) -> str:
    if product.number == 0.0:
        return "0"
    between = r"\," if latex else "*"
    parts = [] if abs(abs(product.number) - 1.0) <= NOTHING else [_number(abs(product.number), latex)]
    parts += [_power(name, power, latex) for name, power in product.powers]
    sums, sign = [], 1.0 if product.number > 0.0 else -1.0
    for factor in product.factors:
        waves = _waves(factor)
        if len(waves) == 1:
            powers, turns, sine, value = waves[0]
            sign *= 1.0 if value > 0.0 else -1.0
            parts.append(_term((powers, turns, sine, abs(value)), names, latex))
        else:
            inside = "".join(
                f" {'+' if wave[3] > 0.0 else '-'} {_term((*wave[:3], abs(wave[3])), names, latex)}" for wave in waves
            )
            inside = inside[3:] if inside.startswith(" + ") else f"-{inside[3:]}"
            sums.append(rf"\left({inside}\right)" if latex else f"({inside})")
    text = between.join([*parts, *sums]) or "1"
    return text if sign > 0.0 else f"-{text}"


def _term(wave: Wave, names: Names, latex: bool) -> str:
    powers, turns, sine, value = wave
    parts = [] if abs(value - 1.0) <= NOTHING else [_number(value, latex)]
    parts += [_power(name, power, latex) for name, power in powers]
    if any(turns):
        parts.append(_wave(turns, sine, names, latex))
    return (r"\," if latex else "*").join(parts) or "1"


def _number(value: float, latex: bool) -> str:
    return latex_number(value) if latex else f"{value:.12g}"


def _power(name: str, power: int, latex: bool) -> str:
    if not latex:
        return name if power == 1 else f"{name}**{power}"
    twist = re.fullmatch(r"(sin|cos)\(alpha(\d+)\)", name)
    if twist:
        shown = rf"\{twist[1]}\alpha_{{{twist[2]}}}"
        return shown if power == 1 else rf"\{twist[1]}^{{{power}}}\alpha_{{{twist[2]}}}"
    shown = f"{name[0]}_{{{name[1:]}}}" if len(name) > 2 else f"{name[0]}_{name[1:]}"
    return shown if power == 1 else f"{shown}^{{{power}}}"


def _wave(turns: Turns, sine: bool, names: Names, latex: bool) -> str:
    function = "sin" if sine else "cos"
    joints = [k + 1 for k, times in enumerate(turns) if times]
    if latex and all(times in (0, 1) for times in turns) and all(joint < 10 for joint in joints):
        index = "".join(map(str, joints))
        return f"{function[0]}_{{{index}}}" if len(index) > 1 else f"{function[0]}_{index}"
    inside = ""
    for joint in joints:
        times = turns[joint - 1]
        one = _angle(joint, names, latex)
        if not latex and joint in names.offsets and times != 1:
            one = f"({one})"
        size = one if abs(times) == 1 else f"{abs(times)}{'' if latex else '*'}{one}"
        inside += (" - " if times < 0 else " + ") + size if inside else ("-" if times < 0 else "") + size
    return rf"\{function}({inside})" if latex else f"{function}({inside})"


def _angle(joint: int, names: Names, latex: bool) -> str:
    offset = names.offsets.get(joint)
    if latex:
        return f"{'q' if offset is None else chr(92) + 'theta'}_{{{joint}}}"
    return f"q{joint}" if offset is None else f"q{joint} {'-' if offset < 0.0 else '+'} {abs(offset)!r}"
