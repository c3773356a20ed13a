"""Numbers as people write them: ``-pi/2``, ``3π/4``, ``sqrt(2)/2``. A small parser; nothing is ever executed."""

from __future__ import annotations

import ast
import math
import operator
import re
import unicodedata
from collections.abc import Callable

import numpy as np

from armlab.errors import InputError

LONGEST = 120
"""Characters of one expression; more is a mistake in splitting a table, or mischief."""

_TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|(pi|sqrt)|(\*\*|[-+*/^()]))")
_BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
}
_SYMBOLS = str.maketrans(
    {
        **dict.fromkeys("−–—‒﹣－‐‑", "-"),
        **dict.fromkeys("·×⋅∙∗", "*"),
        **dict.fromkeys("º˚∘", "°"),
        **dict.fromkeys("\u00a0\u2007\u2009\u202f\u200a", " "),
        **dict.fromkeys("\u200b\ufeff\u2061\u2062", ""),
        "√": "sqrt",
        "⁄": "/",
        "∕": "/",
    }
)

# What follows would run together with a digit before it when its characters are folded: 1½ to 11/2, 3² to 32.
_MIXED = re.compile(r"(?:(\d+(?:\.\d*)?)\s*)?([¼½¾⅐-⅞↉])")
_POWER = re.compile("(?<![ⁱʲᵏⁿᵐ⁰¹²³⁴-⁻])([⁺⁻]?[⁰¹²³⁴-⁹]+)")
_ROOT = re.compile(r"√\s*(\d+(?:\.\d*)?|\.\d+|π)")
_RUN_TOGETHER = re.compile(r"(?<=\d)(?=[₀-₉⅟])")


def plain_symbols(text: str) -> str:
    """Return text with the signs of print and of screens replaced by those of a keyboard; ``°`` stays.

    Superscripts become powers, but a zero alone, which is a degree sign to those who type it.

    >>> plain_symbols("−½·π, aⱼ₋₁"), plain_symbols("1½, 10⁻³, √2")
    ('-(1/2)*pi, aj-1', '(1+1/2), 10^(-3), sqrt(2)')
    """
    text = _POWER.sub(lambda power: "°" if power[1] == "⁰" else f"^({power[1]})", text)
    text = _ROOT.sub(r"√(\1)", _MIXED.sub(_mixed, _RUN_TOGETHER.sub(" ", text)))
    folded = unicodedata.normalize("NFKC", text.translate(_SYMBOLS)).translate(_SYMBOLS)
    return re.sub("[πΠϖ]", "pi", folded)


def _mixed(found: re.Match[str]) -> str:
    """Return a vulgar fraction in brackets, with the whole number before it; a decimal number cannot stand there."""
    whole, fraction = found.groups()
    if whole and "." in whole:
        return f"{whole} {unicodedata.numeric(fraction)}"
    return f"({whole}+{fraction})" if whole else f"({fraction})"


def evaluate(text: str) -> float:
    """Return the value of an expression of numbers, pi, sqrt, + - * / ^ and brackets.

    A product may leave out its sign, as in ``3pi/4``; it is then evaluated from left to right like any other.

    Raises
    ------
    InputError
        Anything else, or a value that is not finite.

    Examples
    --------
    >>> evaluate("-pi/2") == -math.pi / 2, evaluate("2 sqrt(2)") == 2 * math.sqrt(2)
    (True, True)
    """
    try:
        tree = ast.parse(_normalised(text), mode="eval")
        value = _value(tree.body)
    except (SyntaxError, ValueError, ZeroDivisionError, OverflowError, RecursionError, MemoryError):
        raise _unreadable(text) from None
    if not math.isfinite(value):
        raise _unreadable(text)
    return value


def shortest_degrees(value: float) -> str:
    """Return the shortest number of degrees that NumPy turns into this float of radians, or the nearest there is.

    >>> shortest_degrees(float(np.radians(90.0))), shortest_degrees(-math.pi / 6)
    ('90', '-30')
    """
    degrees = math.degrees(value)
    candidates = [float(f"{degrees:.{digits}g}") for digits in range(1, 18)]
    candidates += [math.nextafter(degrees, math.inf), math.nextafter(degrees, -math.inf)]
    return shortest(min(candidates, key=lambda candidate: abs(float(np.radians(candidate)) - value)))


def shortest(value: float) -> str:
    """Return a number that reads back as the same float, without a useless ``.0``.

    >>> shortest(1.0), shortest(0.1), shortest(-0.0)
    ('1', '0.1', '0')
    """
    text = repr(value + 0.0)
    return text.removesuffix(".0")


def _unreadable(text: str) -> InputError:
    cut = text if len(text) <= 40 else text[:37] + "..."
    return InputError(f"expected a number such as 0.5, -pi/2 or sqrt(2)/2, got {cut!r}")


def _normalised(text: str) -> str:
    """Return the expression in Python's signs, with every product written out."""
    source = plain_symbols(text).strip()
    if len(source) > LONGEST:
        raise ValueError("too long")
    parts: list[str] = []
    ended = False  # whether what came before is a complete factor
    position = 0
    while position < len(source):
        token = _TOKEN.match(source, position)
        if token is None:
            raise ValueError("not a token")
        number, name, sign = token.groups()
        if ended and (name or sign == "("):
            parts.append("*")
        elif ended and number:
            raise ValueError("two numbers in a row")
        parts.append(repr(float(number)) if number else name or {"^": "**"}.get(sign, sign))
        ended = bool(number) or name == "pi" or sign == ")"
        position = token.end()
    return " ".join(parts)


def _value(node: ast.expr) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, float):
        return node.value
    if isinstance(node, ast.Name) and node.id == "pi":
        return math.pi
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
        value = _value(node.operand)
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        return _BINARY[type(node.op)](_value(node.left), _value(node.right))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "sqrt":
        (argument,) = node.args
        return math.sqrt(_value(argument))
    raise ValueError("not arithmetic")
